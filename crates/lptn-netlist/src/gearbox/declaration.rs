//! The keys of `[gearbox.NAME]`.

use crate::format::{Role, SectionDeclaration, Takes, key, number, shaped, text, whole, words};

/// The members that have teeth.
const WHEELS: [&str; 5] = ["sun", "planet", "ring", "pinion", "wheel"];
/// All members.
pub(crate) const MEMBERS: [&str; 6] = ["sun", "carrier", "ring", "planet", "pinion", "wheel"];

/// `[gearbox]`, as netlists declare it.
pub(crate) const GEARBOX: SectionDeclaration = SectionDeclaration {
    name: "gearbox",
    sentence: "A stage of gears as one block: speeds, torques, and losses of its meshes, bearings \
        and seals.",
    role: Role::Element,
    keys: &[
        shaped(
            "teeth",
            "table of whole numbers",
            Takes::Members(&WHEELS, &Takes::Number),
            "of `sun`, `planet` and `ring`, or of `pinion` and `wheel`",
            "{ sun = 18, planet = 42, ring = 102 }",
        )
        .needed(),
        whole("planets", "number of planets", "3"),
        words(
            "spacing",
            &["even", "uneven"],
            "whether the planets are at equal angles",
            "\"uneven\"",
        )
        .or("`\"even\"`"),
        words("held", &["ring", "sun", "carrier"], "the member that does not turn", "\"ring\"")
            .or("`\"ring\"`"),
        text("input", "name of a member", "the member that `speed` and `torque` are of", "\"sun\"")
            .or("the first of sun, carrier and ring that turns; the pinion"),
        key("speed", "rad/s", "speed of the input, of either direction", "\"7000 rpm\""),
        key(
            "torque",
            "N m",
            "torque on the input, positive if it drives; without it meshes lose nothing",
            "\"2 N m\"",
        ),
        text(
            "driven_by",
            "name of a gearbox",
            "instead of `speed` and `torque`: the stage whose output is the input",
            "\"first\"",
        ),
        number("ratio", "speed of the input over that of the output, to be checked", "6.67"),
        key("module", "m", "with `torque`: normal module", "\"1 mm\""),
        key("width", "m", "with `torque`: common width of the teeth", "\"10 mm\""),
        key("Ra", "m", "with `torque`: roughness, mean of the two flanks", "\"0.5 um\""),
        number("X_L", "lubricant of the meshes: mineral 1, PAO and ester 0.8", "0.8").or("1"),
        key("pressure_angle", "rad", "normal pressure angle", "\"20 deg\"").or("20 deg"),
        key("helix_angle", "rad", "helix angle", "\"15 deg\"").or("0"),
        shaped(
            "shift",
            "table of numbers",
            Takes::Members(&WHEELS, &Takes::Number),
            "profile shift coefficients; of a ring positive towards its axis",
            "{ sun = 0.3, planet = 0.2, ring = -0.7 }",
        )
        .or("0 for each"),
        key(
            "centre_distance",
            "m",
            "with `torque`: distance of the shafts of each mesh",
            "\"90.5 mm\"",
        )
        .or("that of `shift` without backlash"),
        shaped(
            "addendum",
            "table of numbers",
            Takes::Members(&WHEELS, &Takes::Number),
            "with `torque`: from reference circle to tip, in modules",
            "{ ring = 0.9 }",
        )
        .or("1 + shift - `tip_shortening`"),
        number("tip_shortening", "with `torque`: of all tips in modules", "0.02").or("0"),
        text(
            "lubricant",
            "name of a lubricant",
            "of meshes, and of parts that need one and do not name it",
            "\"iso_vg_220\"",
        ),
        text(
            "scuffing",
            "absolute temperature, or a word",
            "with `torque`: as in [mesh]; each mesh then reports its `margin`",
            "\"mineral_ep\"",
        ),
        text(
            "at",
            "name of a node or boundary",
            "with the temperature of the lubricant; default: the first node that a part heats",
            "\"name of a node\"",
        ),
        shaped(
            "into",
            "name of a node, or table of one for each member",
            Takes::Either(&[Takes::Text, Takes::Members(&MEMBERS, &Takes::Text)]),
            "the heated nodes; a mesh heats its two members in halves",
            "\"name of a node\"",
        )
        .needed(),
        shaped(
            "bearing",
            "table of bearings",
            Takes::Part("bearing"),
            "each as below [bearing], with `on`, the member it carries, instead of `speed`",
            "{ front = { on = \"sun\", model = \"no_load\", d_m = \"30 mm\", f0 = 2 } }",
        ),
        shaped(
            "seal",
            "table of seals",
            Takes::Part("seal"),
            "each as below [seal], with `on` instead of `speed`",
            "{ lip = { on = \"sun\", model = \"shaft\", d = \"20 mm\" } }",
        ),
        shaped(
            "churning",
            "table of gears in oil",
            Takes::Part("churning"),
            "each as below [churning], with `on` instead of `speed`",
            "{ web = { on = \"carrier\", part = \"sides\", D = \"90 mm\", dip = 0.3 } }",
        ),
    ],
    either: &[&["speed", "driven_by"]],
    example: "{ teeth = { sun = 18, planet = 42, ring = 102 }, planets = 3, held = \"ring\", speed = \
        \"7000 rpm\", into = \"name of a node\" }",
    elsewhere: &[
        ("arrangement", "the kind follows from the names below `teeth`"),
        ("n", "the speed of the input is `speed`, the number of planets `planets`"),
        ("mesh", "meshes follow from `teeth` and `torque`; their sizes are keys of the gearbox"),
        ("output", "the output follows from `input` and `held`"),
        ("z", "numbers of teeth are in `teeth`: `teeth = { sun = 18, planet = 42, ring = 102 }`"),
        ("fixed", "the member that does not turn is `held`"),
        ("P", "a heat that is known belongs in [source]"),
    ],
    ..SectionDeclaration::NEW
};

/// The sections of parts that a gearbox may have.
pub(crate) const PARTS: [&str; 3] = ["bearing", "seal", "churning"];

/// Keys of a part of a gearbox instead of its speed.
pub(crate) const ON: &str = "on";
pub(crate) const AGAINST: &str = "against";

/// Tables of numbers of wheels: the key in the block, the beginning of the names of parameters.
pub(super) const OF_WHEELS: [(&str, &str); 2] = [("shift", "x"), ("addendum", "addendum")];
