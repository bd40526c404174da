//! The problems that a network can have, each reported once.

use lptn_laws::Formula;
use lptn_units::{EvalError, Type, format_short};

use crate::error_words::{
    Say, above_zero, by, crossed, evaluation, face_area, in_unit, inside, joins_but, joins_cells,
    joins_sides, keys, most_offset, most_pairs, not_evaluated, not_positive, other_radii, radii,
    stream_help, stream_rows, unused_name, usable, whole_law, whole_law_help, without_brackets,
};
use crate::id::{
    ConductorId, ControlId, Field, FluidId, GridId, GridPatch, Item, NodeId, SignalId, SourceId,
    StateId,
};
use crate::names::list_of_names;
use crate::parts::grid::{GridFace, MOST_CELLS};
use crate::parts::patch::PatchProblem;
use crate::patch_words::{not_on_face, other_patch, patch_field};

/// Help that needs no more than the words.
#[allow(clippy::unnecessary_wraps, reason = "in the form of all helps")]
fn text(help: &str) -> Option<String> {
    Some(help.to_owned())
}

lptn_units::problems! {
/// The kinds of problems of a network.
#[derive(Clone, Debug)]
pub enum BuildErrorKind for |say: &Say<'_>| at (Item, Field) {
    /// Two items of one name space have the same name: the first, and the one that took it again.
    DuplicateName { first: Item, second: Item } = "network::duplicate_name",
        at Some((*second, Field::Name)), says match (say.kind(*first), say.kind(*second)) {
            (a, b) if a == b => format!("two {a}s are named `{}`", say.name),
            (a, b) => format!("the name `{}` is taken twice: by a {a} and by a {b}", say.name),
        }, help Some(unused_name(*first, say.name));
    /// A name that means something inside another item, the whole, or one of its results.
    NameInside { item: Item, whole: Item } = "network::duplicate_name",
        at Some((*item, Field::Name)), says inside(say, *item, *whole),
        help Some(format!("rename one of them, for example `{}`", without_brackets(say.name)));
    /// A name that is not `[A-Za-z_][A-Za-z0-9_]*`.
    BadName { item: Item } = "network::bad_name", at Some((*item, Field::Name)),
        says format!("{} has an invalid name", say.item(*item)),
        help Some(format!("use letters, digits and `_`: `{}`", usable(say.name)));
    /// A name that expressions use for themselves.
    ReservedName { item: Item } = "network::reserved_name", at Some((*item, Field::Name)),
        says format!("{} has a name that is reserved in expressions", say.item(*item)),
        help Some(format!("choose another name, for example `{}_1`", say.name));
    /// A value of the wrong type.
    WrongType { item: Item, field: Field, wanted: Type, found: Type } = "network::wrong_type",
        at Some((*item, *field)),
        says format!("{} must be {wanted}, got {found}", say.field(*item, *field)), help None;
    /// A value that has to be finite and more than zero, but is not.
    NotPositive { item: Item, field: Field, value: f64 } = "network::not_positive",
        at Some((*item, *field)),
        says above_zero(say, (*item, *field), *value), help text(not_positive(*field, *value));
    /// A value that may be zero, but not less.
    Negative { item: Item, field: Field, value: f64 } = "network::negative",
        at Some((*item, *field)),
        says format!(
            "{} must not be negative, got {}",
            say.field(*item, *field), in_unit(*value, *field)
        ),
        help (*field == Field::MinDwell)
            .then(|| "leave it out if it may switch again at once".to_owned());
    /// A value that has to be finite, but is not.
    NotFinite { item: Item, field: Field, value: f64 } = "network::not_finite",
        at Some((*item, *field)),
        says format!("{} must be finite, got {value}", say.field(*item, *field)),
        help text("something is divided by zero, or a number is too large");
    /// An absolute temperature below 0 K.
    BelowAbsoluteZero { item: Item, field: Field, value: f64 } = "network::below_absolute_zero",
        at Some((*item, *field)),
        says format!(
            "{} is below absolute zero: {} K",
            say.field(*item, *field), format_short(*value)
        ),
        help text("0 K is -273.15 degC");
    /// A field that has to be constant depends on `t`.
    DependsOnTime { item: Item, field: Field } = "network::depends_on_time",
        at Some((*item, *field)),
        says format!(
            "{} has to be constant, but depends on the time `t`",
            say.field(*item, *field)
        ),
        help text("sources, boundaries and the values of conductors may depend on `t`; a parameter \
            that should is a [signal]");
    /// A field that has to be known before any result depends on the temperature of a node or
    /// boundary.
    DependsOnResult { item: Item, field: Field } = "network::depends_on_result",
        at Some((*item, *field)),
        says format!(
            "{} cannot depend on the temperature of a node or boundary",
            say.field(*item, *field)
        ),
        help text("sources, conductors and limits may depend on temperatures; a property of a \
            material may depend on its own `T`, a capacity on its own `T` or on states, but not on \
            both");
    /// A comparison whose sides are not linear in `t`: the time at which it changes is not known in
    /// advance.
    ComparisonNotLinear { item: Item, field: Field } = "network::comparison_not_linear",
        at Some((*item, *field)),
        says format!(
            "{} compares something that is not linear in the time `t`",
            say.field(*item, *field)
        ),
        help text("compare `t` itself, for example `if(t < 300 [s], 0 [W], 100 [W])`");
    /// A comparison of a temperature whose change cannot be followed: in a property, or for
    /// equality.
    ComparesTemperature { item: Item, field: Field } = "network::compares_temperature",
        at Some((*item, *field)),
        says format!(
            "{} compares temperatures, or a switched value, in a place where the change cannot be \
             followed",
            say.field(*item, *field)
        ),
        help text("sources and paths may compare temperatures, with `<` or `>`; elsewhere write a \
            smooth change, for example `0.5 * (1 + tanh((T - 80 [degC]) / 1 [K]))`, or a [table]");
    /// A state whose usual size is not a positive number, in SI units.
    StateSize { state: StateId, size: f64 } = "network::state_size",
        at Some((Item::State(*state), Field::UsualSize)),
        says format!("{} needs a usual size of more than zero", say.item(Item::State(*state))),
        help text("its tolerance is 1e-7 of `size`, which is `max - min` or the size of `start` if \
            it is not given: add `size`, the size of a usual change");
    /// A state whose least value is not below its greatest, in SI units.
    StateBounds { state: StateId, bounds: [f64; 2] } = "network::state_bounds",
        at Some((Item::State(*state), Field::Most)),
        says format!(
            "`max` of {} is not above `min`: {} and {} (SI units)",
            say.item(Item::State(*state)), format_short(bounds[1]), format_short(bounds[0])
        ),
        help text("exchange the two, or leave one out");
    /// A state whose start is outside its bounds, in SI units.
    StateStart { state: StateId, start: f64, bound: f64 } = "network::state_start",
        at Some((Item::State(*state), Field::Start)),
        says format!(
            "`start` of {} is beyond its bound: {} and {} (SI units)",
            say.item(Item::State(*state)), format_short(*start), format_short(*bound)
        ),
        help text("a state stays between `min` and `max`: change `start` or the bound");
    /// A state without a rate.
    NoRate { state: StateId } = "network::no_rate",
        at Some((Item::State(*state), Field::Rate)),
        says format!("{} has neither rate of change nor balance", say.item(Item::State(*state))),
        help text("give it `rate`, in its unit per second");
    /// The threshold at which a control switches on lies beyond that at which it switches off, or
    /// both are one.
    ThresholdsCrossed { control: ControlId, fields: [Field; 2], on: f64, off: f64 } =
        "network::thresholds_crossed",
        at Some((Item::Control(*control), fields[0])),
        says crossed(&say.item(Item::Control(*control)), *fields, (*on, *off)),
        help Some(match fields {
            [a @ Field::OnAbove, b] => format!("make `{}` higher than `{}`", a.key(), b.key()),
            [a, b] => format!("make `{}` lower than `{}`", a.key(), b.key()),
        });
    /// A control without thresholds for switching.
    NoThermostat { control: ControlId } = "network::no_thermostat",
        at Some((Item::Control(*control), Field::Name)),
        says format!("the thresholds of control `{}` are not given", say.name),
        help text("write `sense`, `on_above` and `off_below`, or `on_below` and `off_above`");
    /// A share, such as an emissivity, that is not above 0 and at most 1.
    NotAFraction { item: Item, field: Field, value: f64 } = "network::not_a_fraction",
        at Some((*item, *field)),
        says format!(
            "{} must be above 0 and at most 1, got {}",
            say.field(*item, *field), format_short(*value)
        ),
        help text("it is a part of a whole: write `0.8` for 80 %");
    /// An angle that no such part has; in rad, its bounds in degrees.
    Angle { item: Item, field: Field, value: f64, range: [i16; 2] } = "network::angle",
        at Some((*item, *field)),
        says format!(
            "{} must be between {} and {} deg, got {} deg",
            say.field(*item, *field), range[0], range[1], format_short(value.to_degrees())
        ),
        help text("an angle has its unit: `15 deg`");
    /// A count, such as of teeth, that is not a whole number of at least 1.
    NotCounted { item: Item, field: Field, value: f64 } = "network::not_counted",
        at Some((*item, *field)),
        says format!(
            "{} must be a whole number of at least 1, got {}",
            say.field(*item, *field), format_short(*value)
        ),
        help text("teeth are counted");
    /// A value that has to be larger than another, as an outer radius; in SI units.
    Radii { item: Item, fields: [Field; 2], inner: f64, outer: f64 } = "network::radii",
        at Some((*item, fields[1])), says radii(say, (*item, *fields), [*inner, *outer]),
        help Some(other_radii(*fields, [*inner, *outer]));
    /// A path or source with a law of the other, or not one value for each field, or a wrong fluid.
    LawValues { item: Item, formula: Formula } = "network::law_values",
        at Some((*item, Field::Name)),
        says format!(
            "{} needs one value for each field of the law `{}`, and a fluid only if it has one",
            say.item(*item), formula.declaration().name
        ),
        help Some(format!("its fields are {}", keys(*formula)));
    /// A winding whose wires and enamel fill more than round wires can.
    Overfilled { item: Item, share: f64 } = "network::overfilled",
        at Some((*item, Field::Fill)),
        says format!(
            "wires and enamel of {} fill {} of the volume",
            say.item(*item), format_short(*share)
        ),
        help text("round wires fill at most 0.907: check `fill` and `enamel_fill`, which are shares \
            of the whole volume");
    /// A liquidus below the solidus, in K.
    Melting { item: Item, solidus: f64, liquidus: f64 } = "network::melting",
        at Some((*item, Field::Liquidus)),
        says format!(
            "`liquidus` of {}, {} K, is below its `solidus`, {} K",
            say.item(*item), format_short(*liquidus), format_short(*solidus)
        ),
        help text("exchange `solidus` and `liquidus`");
    /// A node with a molten part at its start that does not melt at just
    /// that temperature.
    NotMelting { node: NodeId, temperature: f64 } = "network::not_melting",
        at Some((Item::Node(*node), Field::Initial)),
        says format!(
            "`{}` is to start partly molten, but does not melt at just {temperature} K",
            say.name
        ),
        help text("give the material the solidus and liquidus of the run that wrote the state, or \
            leave the share out");
    /// Shares of a source that are negative or do not sum to 1.
    Shares { source: SourceId, sum: f64 } = "network::shares",
        at Some((Item::Source(*source), Field::Into)),
        says format!(
            "the shares of {} must sum to 1, got {}",
            say.item(Item::Source(*source)), format_short(*sum)
        ),
        help text("make the shares sum to 1");
    /// A source of several nodes of which a value depends on `T`, which could be any of theirs.
    WhichTemperature { source: SourceId, field: Field } = "network::which_temperature",
        at Some((Item::Source(*source), *field)),
        says format!(
            "{} depends on `T`, but it heats several nodes",
            say.field(Item::Source(*source), *field)
        ),
        help text("name the node, for example `steel.T`");
    /// A capacity that is not known and positive at the start of its node.
    CapacityUnknown { node: NodeId, temperature: f64 } = "network::capacity_unknown",
        at Some((Item::Node(*node), Field::Capacity)),
        says format!(
            "the capacity of {} is not known and positive at its start, {} K",
            say.item(Item::Node(*node)), format_short(*temperature)
        ),
        help text("let the table or expression reach `T0` and stay positive there");
    /// A capacity that changes so quickly with temperature that its integral cannot be followed.
    TooQuick { item: Item, field: Field } = "network::capacity_too_quick", at Some((*item, *field)),
        says format!(
            "{} changes too quickly with temperature to be integrated",
            say.field(*item, *field)
        ),
        help text("write a mean instead of the oscillation, or a [table] of its values");
    /// A property of a fluid that is not known and positive where it is needed.
    FluidUnknown { fluid: FluidId, field: Field } = "network::fluid_unknown",
        at Some((Item::Fluid(*fluid), *field)),
        says format!(
            "{} is not known and positive at any usual temperature",
            say.field(Item::Fluid(*fluid), *field)
        ),
        help None;
    /// A period that ends before the last point of its signal, in s.
    PeriodTooShort { signal: SignalId, period: f64, span: f64 } = "network::period_too_short",
        at Some((Item::Signal(*signal), Field::Period)),
        says format!(
            "the period of {}, {} s, is shorter than its points reach, {} s",
            say.item(Item::Signal(*signal)), format_short(*period), format_short(*span)
        ),
        help Some(format!("write `period = \"{span} s\"` or more"));
    /// Points of a signal that are not as many times as values, one at least, finite, the times
    /// rising.
    SignalPoints { signal: SignalId } = "network::signal_points",
        at Some((Item::Signal(*signal), Field::Value)),
        says format!(
            "the points of `{}` are not rising times with one finite value each",
            say.name
        ),
        help None;
    /// An expression that could not be evaluated.
    Evaluation { item: Item, field: Field, error: EvalError } = error.code(),
        at Some((*item, *field)),
        says not_evaluated(&say.field(*item, *field), error), help evaluation(error);
    /// A conductor whose two ends are the same node.
    SelfLink { conductor: ConductorId } = "network::self_link",
        at Some((Item::Conductor(*conductor), Field::To)),
        says format!("{} leads from a place to itself", say.item(Item::Conductor(*conductor))),
        help text("a path leads from one node to another: name two different ends");
    /// A source that heats a boundary, which has no effect.
    SourceIntoBoundary { source: SourceId } = "network::source_into_boundary",
        at Some((Item::Source(*source), Field::Into)),
        says format!("{} heats a boundary", say.item(Item::Source(*source))),
        help text("a boundary keeps its temperature at any heat flow: name a node");
    /// A node without capacity that is not declared massless.
    NoCapacity { node: NodeId } = "network::no_capacity", at Some((Item::Node(*node), Field::Name)),
        says format!("node `{}` has no capacity", say.name),
        help Some(format!(
            "give it a capacity, `{0} = {{ C = \"500 J/K\" }}`, or make it a junction, `{0} = {{ \
             massless = true }}`", say.name
        ));
    /// A node declared massless that has a capacity.
    MasslessWithCapacity { node: NodeId } = "network::massless_with_capacity",
        at Some((Item::Node(*node), Field::Name)),
        says format!("node `{}` is massless but has a capacity", say.name),
        help text("remove `massless = true`, or the capacity");
    /// A node with capacity but without a temperature at the start.
    NoInitialTemperature { node: NodeId } = "network::no_initial_temperature",
        at Some((Item::Node(*node), Field::Name)),
        says format!("{} has no temperature at the start", say.item(Item::Node(*node))),
        help text("add `T0 = \"25 degC\"` to the node, or to [default] for every node");
    /// Nodes that together reach neither a capacity nor a boundary: their temperatures are not
    /// determined.
    FloatingIsland { nodes: Vec<NodeId>, names: Vec<String> } = "network::floating_island",
        at nodes.first().map(|node| (Item::Node(*node), Field::Name)),
        says format!(
            "the temperature of {} is not determined: no boundary and no capacity is connected",
            list_of_names(names)
        ),
        help text("connect one of them to a boundary, or give one of them a capacity");
    /// An element names a node, boundary or end that is not of this builder.
    ForeignId { item: Item } = "network::foreign_id", at Some((*item, Field::Name)),
        says format!("`{}` is joined to something of another network", say.name), help None;
    /// Parameters of another network.
    ForeignParameters = "network::foreign_parameters", at None,
        says "the parameters are those of another network".to_owned(), help None;
    /// A network without any node, and without a path between boundaries.
    Empty = "network::empty", at None, says "the network has no node".to_owned(), help None;
    /// Counts of cells that are not one to three, each at least 1.
    GridCells { grid: GridId, counts: Vec<usize> } = "network::grid_cells",
        at Some((Item::Grid(*grid), Field::Cells)),
        says format!(
            "`cells` of `{}` must be one to three counts of at least 1, got {counts:?}",
            say.name
        ),
        help text("give one to three whole numbers, one for each direction: `cells = [20, 10, 1]`");
    /// More than [`MOST_CELLS`](crate::MOST_CELLS) cells.
    GridTooLarge { grid: GridId, counts: Vec<usize> } = "network::grid_too_large",
        at Some((Item::Grid(*grid), Field::Cells)),
        says format!(
            "`{}` has {} = {:.3e} cells, more than {MOST_CELLS}",
            say.name, by(counts), counts.iter().map(|&count| count as f64).product::<f64>()
        ),
        help text("make the cells larger: half as many along each axis have four times the error");
    /// A sector of a cylinder of 360 deg or more; in rad.
    GridAngle { grid: GridId, angle: f64 } = "network::grid_angle",
        at Some((Item::Grid(*grid), Field::Sector)),
        says format!(
            "`angle` of `{}` is {} deg; a sector has less than 360 deg",
            say.name, format_short(angle.to_degrees())
        ),
        help text("leave `angle` out: the full circle is closed");
    /// A cylinder with a hole whose radii have another ratio than that for which it was cut.
    GridRatio { grid: GridId, ratios: [f64; 2] } = "network::grid_ratio",
        at Field::of_law("r_in").map(|field| (Item::Grid(*grid), field)),
        says format!(
            "`r_in` over `r_out` of `{}` is {} in the netlist and {} with other parameters: rings \
             are cut for one ratio",
            say.name, format_short(ratios[0]), format_short(ratios[1])
        ),
        help text("write the new radii into the netlist, or make `r_in` a multiple of `r_out`");
    /// A grid of a material that lacks a property.
    NoProperty { item: Item, field: Field } = "network::no_property",
        at Some((*item, Field::Material)),
        says format!("the material of `{}` has no `{}`", say.name, field.key()), help None;
    /// A pipe that more than its two streams reach.
    PipeEnds { node: NodeId } = "network::pipe_ends", at Some((Item::Node(*node), Field::Name)),
        says format!("something else than its own stream reaches the pipe `{}`", say.name),
        help text("a pipe exchanges no heat: let paths, sources and other streams end at a node \
            before or after it");
    /// A stream that ends at a face of a grid, which it cannot mix with.
    StreamIntoFace { item: Item } = "network::stream_into_face", at Some((*item, Field::To)),
        says format!("the stream `{}` ends at a face, which is solid", say.name),
        help stream_help();
    /// A path to a face of several cells whose law is one of a whole part.
    WholeLaw { item: Item, end: Field, law: &'static str } = "network::whole_law",
        at Some((*item, *end)), says whole_law(say, law), help whole_law_help();
    /// A path to a stream along a face from something that does not have its rows of cells.
    StreamRows { item: Item, stream: String, rows: usize } = "network::stream_rows",
        at Some((*item, Field::To)), says stream_rows(say, stream, *rows),
        help Some(format!("join a face, or name one of its nodes: `{stream}[1]` to `[{rows}]`"));
    /// A face that a round grid does not have.
    NoFace { item: Item, face: GridFace, name: String } = "network::no_face",
        at Some((*item, Field::To)),
        says format!("`{}` ends at `{name}`, which its body does not have", say.name),
        help text("a body without a hole has no inner face, and a full circle no cuts");
    /// Two faces that are joined but of different shapes.
    FaceShapes { item: Item, faces: [GridFace; 2], names: [String; 2] } = "network::face_shapes",
        at Some((*item, Field::To)), says joins_but(say, names, "and their shapes do not fit"),
        help text("put a massless node between them, with a path to each face");
    /// Two faces that are joined but not divided in the same way: cells of each along its two axes.
    FaceCells { item: Item, faces: [GridFace; 2], names: [String; 2], cells: [[usize; 2]; 2] } =
        "network::face_cells", at Some((*item, Field::To)),
        says joins_cells(say, names, cells), help text("divide both in the same way along the face");
    /// Two faces that are joined but not of the same size: lengths of each along its two axes in m.
    FaceSides { item: Item, faces: [GridFace; 2], names: [String; 2], sides: [[f64; 2]; 2] } =
        "network::face_sides", at Some((*item, Field::To)), says joins_sides(say, names, sides),
        help text("such a path needs two faces of the same lengths: check `size` of both");
    /// Two faces that are joined but do not overlap: the largest offset along each axis in m.
    FacesApart { item: Item, faces: [GridFace; 2], names: [String; 2], most: [f64; 2] } =
        "network::faces_apart", at Some((*item, Field::Offset)),
        says joins_but(say, names, "but they do not overlap"), help Some(most_offset(*most));
    /// Parameters that change the cells at which two faces touch.
    FacesMoved { item: Item, faces: [GridFace; 2], names: [String; 2] } = "network::faces_moved",
        at Some((*item, Field::To)),
        says joins_but(say, names, "and other cells touch for these parameters"),
        help text("cells are paired for the values in the file: write the new ones there");
    /// Two faces that parameters move, and a path that cannot follow.
    FacesMoving { item: Item, faces: [GridFace; 2], names: [String; 2] } = "network::faces_moving",
        at Some((*item, Field::To)), says joins_but(say, names, "which parameters move"),
        help Some(most_pairs());
    /// A patch that does not lie on its face, or on other cells than those of the file.
    Patch { patch: GridPatch, problem: PatchProblem, axes: [&'static str; 2] } = "network::patch",
        at Some((Item::Patch(*patch), patch_field(problem))), says not_on_face(say, problem, axes),
        help Some(other_patch(problem, axes));
    /// A path whose area is not that of the face it ends at, in m^2.
    FaceArea { item: Item, given: f64, face: GridFace, name: String, area: f64 } =
        "network::face_area", at Field::of_law("area").map(|field| (*item, field)),
        says face_area(say, *given, (name, *area)),
        help text("leave `area` out, or write that of the face; a part of a face is a `patch`");
}
}
