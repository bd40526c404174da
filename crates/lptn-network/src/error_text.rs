//! The words of build errors.

use std::fmt;

use lptn_units::format_number;

use crate::error::{BuildError, BuildErrorKind};
use crate::grid::MOST_CELLS;
use crate::id::Field;
use crate::names::list_of_names;
use crate::typed::ZERO_CELSIUS;

impl BuildError {
    /// What to do about it, in words that can be pasted where possible.
    pub fn help(&self) -> Option<String> {
        use BuildErrorKind as K;
        let name = &self.name;
        Some(match &self.kind {
            K::NoCapacity { .. } => format!(
                "give it a capacity, `{name} = {{ C = \"500 J/K\" }}`, or declare it a junction, \
                 `{name} = {{ massless = true }}`"
            ),
            K::MasslessWithCapacity { .. } => "remove `massless = true`, or the capacity".into(),
            K::NoInitialTemperature { .. } => {
                "add `T0 = \"25 degC\"` to the node, or to [default] for every node".into()
            }
            K::FloatingIsland { .. } => {
                "connect one of them to a boundary, or give one of them a capacity".into()
            }
            K::SelfLink { .. } => "a path leads from one node to another: name two different ends".into(),
            K::SourceIntoBoundary { .. } => {
                "a boundary keeps its temperature whatever flows in: name a node".into()
            }
            K::DependsOnTime { .. } => {
                "sources, boundaries and the values of conductors may depend on `t`; a parameter that should is a \
                 [signal]"
                    .into()
            }
            K::DependsOnResult { .. } => {
                "sources, conductors and limits may depend on temperatures; a capacity and a property of a material \
                 may depend on their own `T`"
                    .into()
            }
            K::ComparisonNotLinear { .. } => {
                "compare `t` itself, for example `if(t < 300 [s], 0 [W], 100 [W])`".into()
            }
            K::ComparesTemperature { .. } => {
                "sources and paths may compare temperatures, with `<` or `>`; elsewhere write a smooth change, for \
                 example `0.5 * (1 + tanh((T - 80 [degC]) / 1 [K]))`, or a [table]"
                    .into()
            }
            K::Radii { .. } => "exchange `r_in` and `r_out`".into(),
            K::ThresholdsCrossed { fields: [a, b], .. } => match a {
                Field::OnAbove => format!("make `{}` higher than `{}`", a.key(), b.key()),
                _ => format!("make `{}` lower than `{}`", a.key(), b.key()),
            },
            K::NoThermostat { .. } => {
                "write `sense`, `on_above` and `off_below`, or `on_below` and `off_above`".into()
            }
            K::Melting { .. } => "exchange `solidus` and `liquidus`".into(),
            K::NotMelting { .. } => {
                "give the material the solidus and liquidus of the run that wrote the state, or leave the share out".into()
            }
            K::Shares { .. } => "make the shares sum to 1".into(),
            K::WhichTemperature { .. } => "name the node, for example `steel.T`".into(),
            K::CapacityUnknown { .. } => {
                "let the table or expression reach `T0` and stay positive there".into()
            }
            K::TooQuick { .. } => "write its mean in place of what swings, or a [table] of its values".into(),
            K::PeriodTooShort { span, .. } => format!("write `period = \"{span} s\"` or more"),
            K::BadName { .. } => "use letters, digits and `_`, not a digit first".into(),
            K::ReservedName { .. } => format!("choose another name, for example `{name}_1`"),
            _ => return self.help_of_grid(),
        })
    }

    fn help_of_grid(&self) -> Option<String> {
        use BuildErrorKind as K;
        Some(match &self.kind {
            K::GridCells { .. } => {
                "give one to three whole numbers, along x, y and z: `cells = [20, 10, 1]`".into()
            }
            K::GridTooLarge { .. } => {
                "make the cells larger: half as many along each axis have four times the error".into()
            }
            K::StreamIntoFace { .. } => {
                "let the stream pass a node, and join that to the face by a [convection]".into()
            }
            K::FaceCells { .. } => "divide both in the same way along the face".into(),
            K::FaceSides { .. } => "two faces that touch have the same lengths: check `size` of both".into(),
            K::FaceArea { .. } => {
                "leave `area` out: it is that of the face; a film on a part of it is given by `G` or `R`"
                    .into()
            }
            _ => return None,
        })
    }
}

/// "1 x 2": counts or lengths along the axes.
fn by(numbers: &[impl fmt::Display]) -> String {
    numbers.iter().map(ToString::to_string).collect::<Vec<_>>().join(" x ")
}

/// The words for grids and their faces.
struct OfGrid<'a>(&'a BuildError);

impl fmt::Display for OfGrid<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        use BuildErrorKind as K;
        let name = &self.0.name;
        match &self.0.kind {
            K::GridCells { counts, .. } => {
                write!(f, "`cells` of `{name}` must be one to three counts of at least 1, got {counts:?}")
            }
            K::GridTooLarge { counts, .. } => {
                let all: f64 = counts.iter().map(|&count| count as f64).product();
                write!(f, "`{name}` has {} = {all:.3e} cells, more than {MOST_CELLS}", by(counts))
            }
            K::NoProperty { field, .. } => write!(f, "the material of `{name}` has no `{}`", field.key()),
            K::StreamIntoFace { .. } => write!(f, "the stream `{name}` ends at a face, which is solid"),
            K::FaceCells { names: [a, b], cells: [m, n], .. } => {
                write!(f, "`{name}` joins `{a}` of {} cells to `{b}` of {} cells", by(m), by(n))
            }
            K::FaceSides { names: [a, b], sides: [u, v], .. } => write!(
                f,
                "`{name}` joins `{a}`, {} m = {} m^2, to `{b}`, {} m = {} m^2",
                by(&u.map(rounded)),
                rounded(u[0] * u[1]),
                by(&v.map(rounded)),
                rounded(v[0] * v[1])
            ),
            K::FaceArea { given, name: face, area, .. } => write!(
                f,
                "the area of `{name}`, {} m^2, is not that of the face `{face}`, {} m^2",
                rounded(*given),
                rounded(*area)
            ),
            _ => f.write_str(self.0.code()),
        }
    }
}

/// Without the noise of binary arithmetic.
fn rounded(value: f64) -> f64 {
    format!("{value:.9e}").parse().unwrap_or(value)
}

/// What is wrong with a capacity that cannot be followed.
const TOO_QUICK: &str = "changes too quickly with temperature to be integrated";

/// The words for what only some kinds of elements can have wrong.
struct OfElements<'a>(&'a BuildError);

impl fmt::Display for OfElements<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        use BuildErrorKind as K;
        let name = &self.0.name;
        match &self.0.kind {
            K::ComparesTemperature { field, .. } => {
                write!(
                    f,
                    "`{}` of `{name}` compares temperatures, or what switches, where that cannot be followed",
                    field.key()
                )
            }
            K::ThresholdsCrossed { fields: [a, b], on, off, .. } => {
                let celsius = |t: &f64| format_number(t - ZERO_CELSIUS);
                let one = on.total_cmp(off).is_eq();
                let (on, off) = (celsius(on), celsius(off));
                write!(f, "`{}` and `{}` of `{name}` are ", a.key(), b.key())?;
                if one {
                    return write!(f, "one temperature, {on} degC");
                }
                write!(f, "crossed over: ")?;
                write!(f, "on at {on} degC, off at {off} degC")
            }
            K::NoThermostat { .. } => write!(f, "nothing says when control `{name}` switches"),
            K::Negative { field, value, .. } => {
                write!(f, "`{}` of `{name}` must not be negative, got {value}", field.key())
            }
            K::NotAFraction { field, value, .. } => {
                write!(f, "`{}` of `{name}` must be above 0 and at most 1, got {value}", field.key())
            }
            K::Radii { inner, outer, .. } => {
                write!(f, "`r_out` of `{name}` must be larger than `r_in`, got {outer} m and {inner} m")
            }
            K::Melting { solidus, liquidus, .. } => {
                write!(f, "`liquidus` of `{name}`, {liquidus} K, is below `solidus`, {solidus} K")
            }
            K::NotMelting { temperature, .. } => {
                write!(f, "`{name}` is to start partly molten, but does not melt at just {temperature} K")
            }
            K::Shares { sum, .. } => {
                write!(f, "the shares of `{name}` must not be negative and must sum to 1, got {sum}")
            }
            K::WhichTemperature { .. } => {
                write!(f, "`P` of `{name}` depends on `T`, but it heats several nodes")
            }
            K::CapacityUnknown { temperature, .. } => {
                write!(f, "the capacity of `{name}` is not known and positive at its start, {temperature} K")
            }
            K::TooQuick { field, .. } => write!(f, "`{}` of `{name}` {TOO_QUICK}", field.key()),
            K::FluidUnknown { field, .. } => {
                write!(f, "`{}` of `{name}` is not known and positive at any usual temperature", field.key())
            }
            K::PeriodTooShort { period, span, .. } => {
                write!(f, "the period of `{name}`, {period} s, is shorter than its points reach, {span} s")
            }
            K::SignalPoints { .. } => {
                write!(f, "the points of `{name}` are no rising times with one finite value each")
            }
            _ => OfGrid(self.0).fmt(f),
        }
    }
}

impl fmt::Display for BuildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        use BuildErrorKind as K;
        let name = &self.name;
        match &self.kind {
            K::DuplicateName { .. } => write!(f, "the name `{name}` is taken twice"),
            K::NameInside { whole, .. } => {
                let what =
                    if matches!(whole, crate::id::Item::Grid(_)) { "a grid" } else { "another element" };
                write!(f, "the name `{name}` is taken by a part or a result of {what}")
            }
            K::BadName { .. } => write!(f, "`{name}` is not a name"),
            K::ReservedName { .. } => write!(f, "`{name}` has a meaning of its own in expressions"),
            K::WrongType { field, wanted, found, .. } => {
                write!(f, "`{}` of `{name}` must be {wanted}, got {found}", field.key())
            }
            K::NotPositive { field, value, .. } => {
                write!(f, "`{}` of `{name}` must be finite and more than zero, got {value}", field.key())
            }
            K::NotFinite { field, value, .. } => {
                write!(f, "`{}` of `{name}` must be finite, got {value}", field.key())
            }
            K::BelowAbsoluteZero { field, value, .. } => {
                write!(f, "`{}` of `{name}` is below absolute zero: {value} K", field.key())
            }
            K::DependsOnTime { field, .. } => {
                write!(f, "`{}` of `{name}` has to be constant, but depends on `t`", field.key())
            }
            K::DependsOnResult { field, .. } => {
                write!(f, "`{}` of `{name}` depends on the temperature of a node or boundary", field.key())
            }
            K::ComparisonNotLinear { field, .. } => {
                write!(f, "`{}` of `{name}` compares something that is not linear in `t`", field.key())
            }
            K::Evaluation { field, error, .. } => write!(f, "`{}` of `{name}`: {error}", field.key()),
            K::SelfLink { .. } => write!(f, "`{name}` leads from a node to itself"),
            K::SourceIntoBoundary { .. } => write!(f, "`{name}` heats a boundary"),
            K::NoCapacity { .. } => write!(f, "node `{name}` has no capacity"),
            K::MasslessWithCapacity { .. } => write!(f, "node `{name}` is massless but has a capacity"),
            K::NoInitialTemperature { .. } => write!(f, "node `{name}` has no temperature at the start"),
            K::FloatingIsland { names, .. } => write!(
                f,
                "the temperature of {} is not determined: no boundary and no capacity is connected",
                list_of_names(names)
            ),
            K::ForeignId { .. } => write!(f, "`{name}` is joined to something of another network"),
            K::ForeignParameters => f.write_str("the parameters are those of another network"),
            K::Empty => f.write_str("the network has no node"),
            _ => OfElements(self).fmt(f),
        }
    }
}
