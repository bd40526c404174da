//! What `[gearbox.NAME]` takes.

use crate::format::{Role, SectionDeclaration, key};

/// `[gearbox]`, as netlists declare it.
pub(crate) const GEARBOX: SectionDeclaration = SectionDeclaration {
    name: "gearbox",
    sentence: "A stage of gears as one block: its speeds and torques, and what its meshes, bearings \
        and seals lose.",
    role: Role::Element,
    keys: &[
        key(
            "teeth",
            "table of whole numbers",
            "of `sun`, `planet` and `ring`, or of `pinion` and `wheel`",
            "{ sun = 18, planet = 42, ring = 102 }",
        ),
        key("planets", "whole number", "how many planets there are", "3"),
        key(
            "spacing",
            "`\"even\"`, `\"uneven\"`",
            "whether the planets stand at equal angles",
            "\"uneven\"",
        )
        .or("`\"even\"`"),
        key(
            "held",
            "`\"ring\"`, `\"sun\"`, `\"carrier\"`",
            "the member that stands still",
            "\"ring\"",
        )
        .or("`\"ring\"`"),
        key("input", "name of a member", "the member that `speed` and `torque` are of", "\"sun\"")
            .or("the first of sun, carrier and ring that turns; the pinion"),
        key("speed", "rad/s", "speed of the input, of either direction", "\"7000 rpm\""),
        key(
            "torque",
            "N m",
            "torque on the input, positive where it drives; without it meshes lose nothing",
            "\"2 N m\"",
        ),
        key(
            "driven_by",
            "name of a gearbox",
            "in place of `speed` and `torque`: the stage whose output is the input",
            "\"first\"",
        ),
        key("ratio", "number", "speed of the input over that of the output, to be checked", "6.67"),
        key("module", "m", "with `torque`: normal module", "\"1 mm\""),
        key("width", "m", "with `torque`: common width of the teeth", "\"10 mm\""),
        key("Ra", "m", "with `torque`: roughness, mean of the two flanks", "\"0.5 um\""),
        key("X_L", "number", "lubricant of the meshes: mineral 1, PAO and ester 0.8", "0.8")
            .or("1"),
        key("pressure_angle", "rad", "normal pressure angle", "\"20 deg\"").or("20 deg"),
        key("helix_angle", "rad", "helix angle", "\"15 deg\"").or("0"),
        key(
            "lubricant",
            "name of a lubricant",
            "of meshes, and of parts that take one and have none of their own",
            "\"iso_vg_220\"",
        ),
        key(
            "scuffing",
            "absolute temperature, or a word",
            "with `torque`: as in [mesh]; each mesh tells its `margin` then",
            "\"mineral_ep\"",
        ),
        key(
            "at",
            "name of a node or boundary",
            "whose temperature the lubricant has; the first node that a part heats unless said",
            "\"name of a node\"",
        ),
        key(
            "into",
            "name of a node, or table of one for each member",
            "what is heated; a mesh heats its two members in halves",
            "\"name of a node\"",
        ),
        key(
            "bearing",
            "table of bearings",
            "each as below [bearing], with `on`, the member it carries, in place of `speed`",
            "{ front = { on = \"sun\", model = \"no_load\", d_m = \"30 mm\", f0 = 2 } }",
        ),
        key(
            "seal",
            "table of seals",
            "each as below [seal], with `on` in place of `speed`",
            "{ lip = { on = \"sun\", model = \"shaft\", d = \"20 mm\" } }",
        ),
        key(
            "churning",
            "table of gears in oil",
            "each as below [churning], with `on` in place of `speed`",
            "{ web = { on = \"carrier\", part = \"sides\", D = \"90 mm\", dip = 0.3 } }",
        ),
    ],
    example: "{ teeth = { sun = 18, planet = 42, ring = 102 }, planets = 3, held = \"ring\", speed = \
        \"7000 rpm\", into = \"name of a node\" }",
    elsewhere: &[
        ("arrangement", "which one it is follows from the names below `teeth`"),
        ("n", "the speed of the input is `speed`, the number of planets `planets`"),
        ("mesh", "meshes follow from `teeth` and `torque`; their sizes are keys of the gearbox"),
        ("output", "the output follows from `input` and `held`"),
        ("z", "numbers of teeth stand in `teeth`: `teeth = { sun = 18, planet = 42, ring = 102 }`"),
        ("fixed", "the member that stands still is `held`"),
        ("P", "a heat that is known belongs in [source]"),
    ],
    ..SectionDeclaration::NEW
};

/// The sections of parts that a gearbox may have.
pub(super) const PARTS: [&str; 3] = ["bearing", "seal", "churning"];

/// What a part of a gearbox says in place of its speed.
pub(super) const ON: &str = "on";
pub(super) const AGAINST: &str = "against";
