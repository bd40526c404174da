//! The netlist that a question is about.

use std::io::{ErrorKind, Read as _};
use std::path::Path;
use std::sync::Arc;

use lptn_assembly::{AssemblyError, ThermalSystem};
use lptn_netlist::{
    Diagnostic, Files, GivenTime, MOST_BYTES, Netlist, ReadError, Rejected, RunTime, Span,
    parse_bytes, parse_file, similar_file,
};
use lptn_network::{InputError, Item, ParameterId};
use lptn_report::{Json, Text, plain};
use lptn_units::{Dimension, Problem, Quantity, Type, Unit, UnitError, parse_quantity};

use crate::belief::Belief;
use crate::exit::Exit;
use crate::failure::{Failure, told};
use crate::known_columns::KnownColumns;
use crate::messages;
use crate::overridden;
use crate::parameter;
use crate::words::{counts, unverified, unverified_names};

/// The file of rows in a folder of results.
pub const RESULT: &str = "result.csv";

/// Name of a netlist from stdin.
const STDIN: &str = "<stdin>";

/// The bytes of a netlist and their names.
#[derive(Clone, Debug)]
pub struct Given {
    /// The text as it was read.
    pub bytes: Vec<u8>,
    /// Name in diagnostics and in the manifest.
    pub name: String,
    /// Name of its results: the file's name without its extension.
    pub stem: String,
}

impl Given {
    /// The name for a command that can be typed; `None` for stdin.
    pub fn typed(&self) -> Option<String> {
        (self.name != STDIN).then(|| quoted(&self.name))
    }
}

/// Reads the file, or stdin for `-`.
pub fn read(file: &Path) -> Result<Given, Failure> {
    if file.as_os_str() == "-" {
        let mut bytes = Vec::new();
        let outcome = std::io::stdin().lock().take(MOST_BYTES + 1).read_to_end(&mut bytes);
        outcome.map_err(|error| Failure::cannot_read("stdin", &error, None))?;
        if bytes.len() as u64 > MOST_BYTES {
            let message = format!("stdin is longer than {} MB", MOST_BYTES / 1_000_000);
            return Err(Failure::new(Exit::Input, Diagnostic::error("netlist::too_long", message)));
        }
        return Ok(Given { bytes, name: STDIN.into(), stem: "stdin".into() });
    }
    let name = file.display().to_string();
    let bytes = match lptn_netlist::read_bytes(file) {
        Ok(bytes) => bytes,
        Err(ReadError::Io { error, .. }) => {
            // a file that exists but cannot be read is not misspelt
            let missing = error.kind() == ErrorKind::NotFound;
            return Err(Failure::cannot_read(
                &name,
                &error,
                if missing { similar(file) } else { example(file) },
            ));
        }
        Err(ReadError::Rejected(rejected)) => return Err(rejected.into()),
    };
    let stem =
        file.file_stem().map_or("netlist".into(), |stem| stem.to_string_lossy().into_owned());
    Ok(Given { bytes, name, stem: folder_name(stem) })
}

fn similar(file: &Path) -> Option<String> {
    similar_file(file).map(|near| format!("did you mean {}?", near.display()))
}

/// Help if a folder is given instead of a netlist: its results, or a netlist in it.
fn example(folder: &Path) -> Option<String> {
    if folder.join(RESULT).is_file() {
        let folder = quoted(&folder.display().to_string());
        return Some(format!("it contains results: `lptn plot {folder}` shows them"));
    }
    let entries = std::fs::read_dir(folder).ok()?;
    let paths = entries.filter_map(|entry| entry.ok().map(|entry| folder.join(entry.file_name())));
    let mut files: Vec<_> =
        paths.filter(|path| path.extension().is_some_and(|ending| ending == "toml")).collect();
    files.sort();
    let first = files.into_iter().find(|file| is_netlist(file))?;
    Some(format!("name a netlist in it, for example {}", first.display()))
}

/// True if a file of TOML has the key `format` of netlists.
fn is_netlist(file: &Path) -> bool {
    let text = std::fs::read_to_string(file).unwrap_or_default();
    text.lines().any(|line| line.replace(' ', "").starts_with("format="))
}

/// A network with everything that was set in it.
#[derive(Clone, Debug)]
pub struct Input {
    /// The file.
    pub text: Arc<Given>,
    /// The netlist, with the values that were set.
    pub netlist: Netlist,
    /// Everything that was set in it: by the load case, then separately.
    pub set: Vec<String>,
    /// The words of the command that asked, for reports; empty if a program asked.
    pub command: Vec<String>,
    /// Names and units of its columns.
    pub columns: KnownColumns,
}

/// Sets values in a netlist: those of the load case first, then those of `assignments`.
///
/// # Errors
/// A case that does not exist, and an assignment that does not fit the netlist.
pub fn apply(
    netlist: &mut Netlist,
    text: &Given,
    (case, assignments): (Option<&str>, &[String]),
) -> Result<Vec<String>, Failure> {
    let mut set = Vec::new();
    if let Some(name) = case {
        let cases = &netlist.studies.cases;
        let Some(case) = cases.iter().find(|case| case.name == *name) else {
            return Err(no_case(netlist, text, name));
        };
        let case = case.clone();
        set = netlist.take_case(&case)?;
    }
    overridden::replace(netlist, &set, assignments)?;
    set.extend_from_slice(assignments);
    Ok(set)
}

fn no_case(netlist: &Netlist, text: &Given, name: &str) -> Failure {
    let cases = &netlist.studies.cases;
    let names = || cases.iter().map(|case| case.name.as_str());
    let message = format!("{} has no [case.{name}]", text.name);
    let problem = Diagnostic::error("input::no_case", message);
    let problem = match cases.is_empty() {
        true => {
            let set = parameter::set(netlist).unwrap_or_else(|| "p = \"..\"".to_owned());
            problem.help(format!("add for example:\n\n[case.{name}]\nset = {{ {set} }}"))
        }
        false => problem.did_you_mean(name, names(), || {
            let list: Vec<String> = names().map(|name| format!("`{name}`")).collect();
            format!("the cases are {}", list.join(", "))
        }),
    };
    Failure::new(Exit::Input, problem)
}

impl Input {
    /// Reads a netlist as it is.
    ///
    /// # Errors
    /// All problems of the netlist.
    pub fn read(file: impl AsRef<Path>) -> Result<Self, Failure> {
        Self::open(file.as_ref(), &Belief::Named, (None, &[]))
    }

    /// Gives parameters other values, such as `G_fan = 2 W/K`.
    ///
    /// # Errors
    /// An assignment that does not fit the netlist.
    pub fn set(mut self, assignments: &[&str]) -> Result<Self, Failure> {
        let texts: Vec<String> = assignments.iter().map(|text| (*text).to_owned()).collect();
        self.netlist.set(&texts)?;
        self.set.extend(texts);
        Ok(self)
    }

    /// Reads a netlist and sets values in it.
    /// They are those of a fit, of a load case, and of assignments, in this order.
    ///
    /// # Errors
    /// All problems of the netlist or of the values.
    pub fn open(
        file: &Path,
        belief: &Belief<'_>,
        settings: (Option<&str>, &[String]),
    ) -> Result<Self, Failure> {
        let text = Arc::new(read(file)?);
        let netlist = parse(&text)?;
        Self::of((text, netlist), belief, settings)
    }

    /// Sets values in a netlist that was parsed, in the order of [`Input::open`].
    ///
    /// # Errors
    /// All problems of the values.
    pub fn of(
        (mut text, mut netlist): (Arc<Given>, Netlist),
        belief: &Belief<'_>,
        (case, assignments): (Option<&str>, &[String]),
    ) -> Result<Self, Failure> {
        belief.take(&mut netlist)?;
        let set = apply(&mut netlist, &text, (case, assignments))?;
        if let Some(case) = case {
            // next to the results of the other cases
            let stem = folder_name(format!("{}_{case}", text.stem).replace(['/', '\\'], "_"));
            Arc::make_mut(&mut text).stem = stem;
        }
        Ok(Self { text, netlist, set, command: Vec::new(), columns: KnownColumns::default() })
    }

    /// The same with another stop of the run and another interval between its rows. They are
    /// checked with the values, not before them.
    ///
    /// # Errors
    /// As [`Input::of`], a text that is not a time, and a time that does not fit the run.
    pub fn of_run(
        (text, mut netlist): (Arc<Given>, Netlist),
        (belief, times): (&Belief<'_>, [Option<&str>; 2]),
        settings: (Option<&str>, &[String]),
    ) -> Result<Self, Failure> {
        netlist.replace_run_times(&given_times(times)?);
        let mut input = Self::of((text, netlist), belief, settings)?;
        input.netlist.set_run_times(&[])?;
        Ok(input)
    }

    /// Gives the run another stop and another interval between its rows.
    ///
    /// # Errors
    /// A text that is not a time, and a time that does not fit the run.
    pub fn set_times(&mut self, stop: Option<&str>, every: Option<&str>) -> Result<(), Failure> {
        Ok(self.netlist.set_run_times(&given_times([stop, every])?)?)
    }

    /// Name of the network: its title, else the name of its file.
    pub fn title(&self) -> String {
        self.netlist.network.title().map_or_else(|| self.text.stem.clone(), plain)
    }

    /// Begins a text about the network: its title, and the numbers of its parts.
    pub fn begun(&self) -> Text {
        let mut text = Text::titled(self.title());
        text.line(counts(&self.netlist.network));
        if let Some(unsure) = unverified(&self.netlist.network) {
            text.sentence("", &unsure);
        }
        text
    }

    /// Begins the object of a result.
    pub fn head(&self, json: &mut Json<'_>, more: &[Diagnostic]) -> std::io::Result<()> {
        let warnings = [self.netlist.warnings.as_slice(), more].concat();
        messages::head(json, Some(&self.text.stem), (&self.netlist.files, &warnings))?;
        json.optional("unverified_constants", unverified_names(&self.netlist.network))
    }

    /// The place of the node of this name.
    pub fn node_place(&self, name: &str) -> Option<Span> {
        let node = self.netlist.network.node(name).ok()?;
        self.netlist.source_map.name(Item::Node(node))
    }

    /// The name for a command that can be typed; `None` for stdin.
    pub fn typed(&self) -> Option<String> {
        self.text.typed()
    }

    /// The unit in which the file writes a parameter, else the usual one of its type.
    pub fn unit_of(&self, parameter: ParameterId) -> Unit {
        let ty = self.netlist.network.parameters()[parameter.index()].ty;
        let written = self.netlist.written_number(parameter).map(|written| written.unit);
        let si = |ty: Type| Unit { text: ty.dimension.si_unit(), scale: 1.0, offset: 0.0, ty };
        written.or_else(|| Unit::parse(&ty.usual_unit()).ok()).unwrap_or_else(|| si(ty))
    }

    /// The place of an input that has no value.
    pub fn place_of(&self, error: &InputError) -> Option<Span> {
        let map = &self.netlist.source_map;
        map.get(error.item, error.field).or_else(|| map.name(error.item))
    }

    /// A failure of the netlist at its place.
    pub fn failure(&self, problem: &dyn Problem, place: Option<Span>) -> Failure {
        self.refused(problem.class().into(), told(problem).at(place, ""))
    }

    /// The same for a diagnostic with its own exit code.
    pub fn refused(&self, exit: Exit, problem: Diagnostic) -> Failure {
        Failure::at(exit, self.netlist.files.clone(), problem)
    }

    /// The equations of the network.
    ///
    /// # Errors
    /// A node with more neighbours than can be eliminated.
    pub fn assemble(&self) -> Result<ThermalSystem, Failure> {
        ThermalSystem::assemble(&self.netlist.network).map_err(|error| {
            let AssemblyError::TooManyNeighbours { node, .. } = &error;
            self.failure(&error, self.netlist.source_map.name(Item::Node(*node)))
        })
    }
}

/// The stop and the interval between rows as times.
fn given_times<'t>(texts: [Option<&'t str>; 2]) -> Result<Vec<GivenTime<'t>>, Failure> {
    let given = [RunTime::Stop, RunTime::Every].into_iter().zip(texts);
    let read = |(which, text): (RunTime, &'t str)| {
        let time = quantity(which.option(), text, Type::of(Dimension::TIME))?;
        Ok((which, text, time.value))
    };
    given.filter_map(|(which, text)| Some((which, text?))).map(read).collect()
}

/// The netlist of a text.
///
/// # Errors
/// All problems of the netlist.
pub fn parse(text: &Given) -> Result<Netlist, Rejected> {
    match text.name.as_str() {
        STDIN => parse_bytes(STDIN, &text.bytes),
        name => parse_file(Path::new(name), &text.bytes),
    }
}

/// A word for the shell, in quotes if it needs them.
pub fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "_-./+,:@%".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        return word.to_owned();
    }
    format!("'{}'", word.replace('\'', "'\\''"))
}

/// A name for the folder of results: `...toml` would lead out of it.
fn folder_name(stem: String) -> String {
    if matches!(stem.as_str(), "" | "." | "..") { "netlist".into() } else { stem }
}

/// The tolerance of the command line in K.
pub fn tolerance(text: &str) -> Result<f64, Failure> {
    let what = (Dimension::TEMPERATURE, "run::settings", "1e-5K");
    Ok(positive("--tolerance", text, what)?.value)
}

/// The unit for temperatures: that of the command line, or that of the netlist.
pub fn temperature_unit(text: Option<&str>, netlist: &Netlist) -> Result<Unit, Failure> {
    match text {
        Some(text) => scale_of("--temperature-unit", text),
        None => checked("temperature_unit", &netlist.temperature_unit),
    }
}

/// The scale of temperature that an option names.
pub fn scale_of(option: &str, text: &str) -> Result<Unit, Failure> {
    checked(option, &Unit::parse(text).map_err(|error| wrong_unit(option, text, &error))?)
}

fn checked(name: &str, unit: &Unit) -> Result<Unit, Failure> {
    scale(unit).ok_or_else(|| {
        let message = format!("{name} must be a temperature scale, got `{}`", unit.text);
        Failure::refused("units::dimension", message, "choose degC, K, degF or degR")
    })
}

/// The scale that a unit is, by its usual name: `°C` is degC.
pub(crate) fn scale(unit: &Unit) -> Option<Unit> {
    let same = |known: &Unit| {
        known.ty.dimension == unit.ty.dimension
            && known.scale.to_bits() == unit.scale.to_bits()
            && known.offset.to_bits() == unit.offset.to_bits()
    };
    ["degC", "K", "degF", "degR"].iter().filter_map(|name| Unit::parse(name).ok()).find(same)
}

/// The quantity that an option gives.
pub fn quantity(option: &str, text: &str, ty: Type) -> Result<Quantity, Failure> {
    parse_quantity(text, Some(ty)).map_err(|error| wrong_unit(option, text, &error))
}

/// The value in SI units of a quantity that an option gives, which must be above zero.
pub fn positive(
    option: &str,
    text: &str,
    (dimension, code, example): (Dimension, &'static str, &str),
) -> Result<Quantity, Failure> {
    let quantity = quantity(option, text, Type::of(dimension))?;
    if quantity.value > 0.0 && quantity.value.is_finite() {
        return Ok(quantity);
    }
    let message = format!("{option} must be more than zero, got `{text}`");
    let help = format!("write for example {option} {example}");
    Err(Failure::refused(code, message, help))
}

/// A mistake in a quantity of the command line, shown in its text.
pub fn wrong_unit(name: &str, text: &str, error: &UnitError) -> Failure {
    let mut files = Files::new();
    let file = files.add(name, text);
    let mut problem = told(error).at(Span::new(file, error.span.clone()), "");
    if problem.message.starts_with("must be ") {
        problem.message = format!("`{name}` {}", problem.message);
    }
    Failure::at(Exit::Input, files, problem)
}

#[cfg(test)]
mod tests {
    use super::quoted;

    #[test]
    fn words_are_quoted_where_the_shell_would_split_them() {
        assert_eq!(quoted("networks/gearbox.toml"), "networks/gearbox.toml");
        assert_eq!(quoted("my gearbox.toml"), "'my gearbox.toml'");
        assert_eq!(quoted("it's"), "'it'\\''s'");
    }
}
