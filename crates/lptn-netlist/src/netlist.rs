//! The whole way: text to [`Netlist`], or all errors.

use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use foldhash::HashSet;
use lptn_data::{
    Diagnostic, FileId, Files, ReadError, Rejected, Severity, Span, arrange, read_bytes,
    read_named, shorten,
};
use lptn_network::{Network, Parameters, RunSettings, Value};
use lptn_units::Unit;

use crate::csv_files::CsvFiles;
use crate::elaborate::{Elaborated, elaborate};
use crate::foster::{self, Chain};
use crate::gearbox::{self, Gearbox, Gears};
use crate::head;
use crate::import;
use crate::include::{self, Loader, Merged};
use crate::initial::{self, InitialState, StateFile};
use crate::overhang;
use crate::pipe;
use crate::plausible;
use crate::posterior::Believed;
use crate::raw::{RawEntry, RawNetlist};
use crate::run::{RUN, RunPlan};
use crate::section::{self, Studies};
use crate::source_map::SourceMap;
use crate::streams;
use crate::syntax;
use crate::syntax_error::NOT_CLOSED;
use crate::template::{self, Expanded, Structure};
use crate::uncertainty::{self, UncertaintyPlan};
use crate::unlikely;
use crate::{assumed, case};
use crate::{controller, hydraulic};
use crate::{enclosure, foreign};

/// A network as a netlist describes it, with the way back to the text.
#[derive(Clone, Debug)]
pub struct Netlist {
    /// The network, with the parameters of the file and of [`Netlist::set`].
    pub network: Network,
    /// The run to simulate; `None` without `[run]`.
    pub run: Option<RunSettings>,
    /// Its studies.
    pub studies: Studies,
    /// The place of each part of the network.
    pub source_map: Arc<SourceMap>,
    /// The texts that places refer to.
    pub files: Files,
    /// Warnings: things that are probably not meant as they are written, or as they result from the
    /// parameters that were set.
    pub warnings: Vec<Diagnostic>,
    /// Those warnings that follow from the text alone.
    pub(crate) written: Vec<Diagnostic>,
    /// The unit in which temperatures are shown; default: degC.
    pub temperature_unit: Unit,
    pub(crate) plan: Option<RunPlan>,
    /// The state that runs start from.
    pub(crate) initial: Option<InitialState>,
    /// Joint knowledge of the parameters.
    pub(crate) uncertainty: UncertaintyPlan,
    /// The load case that was taken.
    pub(crate) case: Option<String>,
    /// The result of a fit.
    pub(crate) believed: Option<Believed>,
    /// Everything that was set up to now.
    pub(crate) assigned: Parameters,
    pub(crate) inputs: Vec<FileId>,
    /// The structure that templates gave it.
    pub(crate) structure: Arc<Structure>,
    pub(crate) gearboxes: Vec<Gearbox>,
}

impl Netlist {
    /// The files it was read from, its own first, then those it includes and its CSV files: name
    /// and text.
    pub fn inputs(&self) -> impl Iterator<Item = (&str, &str)> {
        self.inputs.iter().map(|&id| (self.files.name(id), self.files.text(id)))
    }

    /// The same files with their contents, which differ from the text if they are not in UTF-8.
    pub fn input_bytes(&self) -> impl Iterator<Item = (&str, &[u8])> {
        self.inputs.iter().map(|&id| (self.files.name(id), self.files.bytes(id)))
    }

    /// Finds the warnings again, for the current parameters.
    pub(crate) fn judge(&mut self) {
        let (network, map) = (&self.network, &self.source_map);
        let start = self.run.as_ref().map_or(0.0, |run| run.start);
        let mut all = self.written.clone();
        all.extend(streams::unbalanced(network, map, start));
        all.extend(streams::wrong_outlets(network, map, start));
        all.extend(plausible::materials(network, map));
        all.extend(plausible::neighbours(network, map));
        all.extend(overhang::warnings(network, map));
        all.extend(gearbox::doubts(network, map, &self.gearboxes));
        all.extend(assumed::mean_conductivities(network, map));
        all.extend(unlikely::values(network, map));
        all.extend(uncertainty::of_zero(network, map, &self.assigned));
        all.extend(
            self.initial
                .iter()
                .flat_map(|state| initial::warnings(state, self.plan.as_ref(), network)),
        );
        let tolerance = self.run.iter().map(|run| run.tolerance);
        all.extend(tolerance.flat_map(|tolerance| section::narrow(network, map, tolerance)));
        arrange(&self.files, &mut all);
        shorten(&mut all, 0);
        self.warnings = all;
    }

    /// The reason why a path such as `planet[9].gear` is unknown, and the correction, if its index
    /// is wrong.
    pub fn no_instance(&self, path: &str) -> Option<(String, String)> {
        self.structure.wrong_path(path).map(|wrong| (wrong.why, wrong.help))
    }

    /// The state that runs start from, if `initial` of `[run]` names one.
    pub fn initial(&self) -> Option<&InitialState> {
        self.initial.as_ref()
    }

    /// Everything that `[run]` evaluates.
    pub fn run_values(&self) -> impl Iterator<Item = &Value> {
        self.plan.iter().flat_map(RunPlan::values)
    }

    /// The stages of gears; each follows the one that drives it.
    pub fn gearboxes(&self) -> &[Gearbox] {
        &self.gearboxes
    }

    /// The run to simulate with the parameters of `network`, which is this one with others; `None`
    /// without `[run]`.
    ///
    /// # Errors
    /// The errors that they cause in `[run]`: it ends before it begins, a signal ends earlier.
    pub fn run_of(&self, network: &Network) -> Result<Option<RunSettings>, Vec<Diagnostic>> {
        self.plan.as_ref().map(|plan| plan.settings(network)).transpose()
    }

    /// The parameters as they were set, for [`Network::with`] with further ones.
    pub fn overrides(&self) -> Parameters {
        self.assigned.clone()
    }
}

/// Reads the text of a file without its meaning. The tree contains everything that could be read,
/// whatever is wrong elsewhere.
pub fn parse_raw(files: &Files, file: FileId) -> (RawNetlist, Vec<Diagnostic>) {
    syntax::read(files, file, section::format())
}

/// Reads a netlist from a file.
///
/// # Errors
/// [`ReadError`] if the file cannot be read, is longer than [`MOST_BYTES`](crate::MOST_BYTES), or
/// its content cannot be used.
pub fn read(path: &Path) -> Result<Netlist, ReadError> {
    parse_file(path, &read_bytes(path)?).map_err(ReadError::Rejected)
}

/// Reads a netlist from the bytes of a file that was read. Its included files and CSV files are
/// searched for in the folder of `path`.
///
/// # Errors
/// [`Rejected`] with every problem.
pub fn parse_file(path: &Path, bytes: &[u8]) -> Result<Netlist, Rejected> {
    decode(&path.display().to_string(), bytes, Some(&mut read_named))
}

/// Reads a netlist from bytes that may not be text; `name` is its name in diagnostics. It cannot
/// name other files.
///
/// # Errors
/// [`Rejected`] with every problem.
pub fn parse_bytes(name: &str, bytes: &[u8]) -> Result<Netlist, Rejected> {
    decode(name, bytes, None)
}

fn decode(name: &str, bytes: &[u8], loader: Option<&mut Loader<'_>>) -> Result<Netlist, Rejected> {
    match std::str::from_utf8(bytes) {
        Ok(text) => whole(name, text, loader),
        Err(_) if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) => {
            Err(not_text((name, ""), 0..0, "it looks like UTF-16"))
        }
        Err(error) => {
            let at = error.valid_up_to();
            let line = bytes.iter().take(at).filter(|&&byte| byte == b'\n').count() + 1;
            let text = String::from_utf8_lossy(bytes);
            let place = at..at + char::REPLACEMENT_CHARACTER.len_utf8();
            let why = format!("byte {at} on line {line} belongs to no character");
            Err(not_text((name, text.as_ref()), place, &why))
        }
    }
}

/// Reads a netlist from text; `name` is its name in diagnostics. It cannot name other files.
///
/// # Errors
/// [`Rejected`] with every problem.
pub fn parse(name: &str, text: &str) -> Result<Netlist, Rejected> {
    whole(name, text, None)
}

/// Reads a netlist from text; `loader` reads its included files and its CSV files, by paths
/// relative to that of `name`.
///
/// # Errors
/// [`Rejected`] with every problem.
pub fn parse_with(name: &str, text: &str, loader: &mut Loader<'_>) -> Result<Netlist, Rejected> {
    whole(name, text, Some(loader))
}

fn whole(name: &str, text: &str, loader: Option<&mut Loader<'_>>) -> Result<Netlist, Rejected> {
    let mut files = Files::new();
    if text.contains('\0') {
        return Err(not_text((name, ""), 0..0, "it contains zero bytes"));
    }
    let file = files.add(name, text);
    let (raw, mut diagnostics) = syntax::read(&files, file, section::format());
    let syntax = !diagnostics.is_empty();
    if diagnostics.first().is_some_and(|problem| problem.code == foreign::CODE) {
        return Err(Rejected { files, diagnostics, syntax });
    }
    if raw.top.entries.is_empty() && !syntax {
        let empty = head::empty(text, Span::new(file, 0..0));
        return Err(Rejected { files, diagnostics: vec![empty], syntax });
    }
    if !syntax {
        return included(files, raw, (Path::new(name), file), loader);
    }
    // errors of templates may follow from the broken line
    let (Expanded { raw, structure, .. }, ShortForms { gears, pipes, .. }) =
        written_out(&mut files, raw);
    let written = (&structure, &gears, &pipes[..]);
    let (_, found) = elaborate(&raw, written, &CsvFiles::default(), None);
    add_certain(&mut diagnostics, found.problems, (&files, file));
    Err(Rejected { syntax, ..Rejected::arranged(files, diagnostics, found.dropped) })
}

/// Parts of a text that were written out as elements.
struct ShortForms {
    gears: Gears,
    chains: Vec<Chain>,
    pipes: Vec<RawEntry>,
}

/// Every template, gearbox, flow network, controller, chain and pipe as elements.
fn written_out(files: &mut Files, raw: RawNetlist) -> (Expanded, ShortForms) {
    let mut expanded = template::expand(files, raw, section::format());
    let Expanded { raw, structure, problems } = &mut expanded;
    let mut gears = gearbox::expand(raw, structure, problems);
    gears.types.extend(hydraulic::expand(raw, structure, problems));
    gears.types.extend(controller::expand(raw, structure, problems));
    enclosure::expand(raw, structure, problems);
    let (chains, types) = foster::expand(raw, structure, problems);
    gears.types.extend(types);
    let pipes = pipe::expand(raw, structure);
    (expanded, ShortForms { gears, chains, pipes })
}

/// The rest of the way for a text that is TOML.
fn included(
    mut files: Files,
    raw: RawNetlist,
    main: (&Path, FileId),
    mut loader: Option<&mut Loader<'_>>,
) -> Result<Netlist, Rejected> {
    let Merged { raw, problems: mut diagnostics, incomplete, syntax } =
        include::merge((&mut files, section::format()), raw, main, loader.as_deref_mut());
    if incomplete {
        return Err(Rejected { syntax, ..Rejected::arranged(files, diagnostics, 0) });
    }
    let (Expanded { raw, structure, problems }, ShortForms { gears, chains, pipes }) =
        written_out(&mut files, raw);
    diagnostics.extend(problems);
    let initial = raw.section(RUN.name).and_then(|run| run.get("initial"));
    let state =
        initial.map(|named| StateFile::read(&mut files, &named.value, loader.as_deref_mut()));
    let long = import::files(&raw).chain(Studies::files(&raw));
    let posterior = uncertainty::load(&mut files, &raw, loader.as_deref_mut());
    let csv = CsvFiles::read(&mut files, (&raw, section::format()), long, loader);
    let (done, mut found) = elaborate(&raw, (&structure, &gears, &pipes), &csv, state.as_ref());
    if include::any_error(&diagnostics) {
        found.problems.retain(|problem| problem.severity == Severity::Error);
    }
    let done = done.filter(|_| !include::any_error(&diagnostics));
    diagnostics.extend(found.problems);
    arrange(&files, &mut diagnostics);
    match done {
        Some(done) => {
            let initial = state.map(|file| file.state.replacing(&done));
            let made = Made { done, gearboxes: gears.list, chains, initial, posterior };
            finish(files, made, diagnostics)
        }
        None => Err(Rejected { syntax, ..Rejected::arranged(files, diagnostics, found.dropped) }),
    }
}

/// The results of a text and the files it names.
struct Made {
    done: Elaborated,
    gearboxes: Vec<Gearbox>,
    chains: Vec<Chain>,
    initial: Option<InitialState>,
    posterior: uncertainty::Found,
}

fn finish(
    files: Files,
    Made { done, gearboxes, chains, initial, posterior }: Made,
    mut diagnostics: Vec<Diagnostic>,
) -> Result<Netlist, Rejected> {
    let Elaborated { network, run: plan, studies, uncertainty, map, temperature_unit, .. } = done;
    let run = plan.as_ref().map(|plan| plan.settings(&network)).transpose();
    let mut problems = studies.check(&network);
    problems.extend(gearbox::check(&gearboxes, &network, &map));
    problems.extend(foster::check(&chains, &network, &map));
    let mut assigned = network.overrides();
    let believed = uncertainty::known(&uncertainty, &network, posterior, &mut assigned);
    let believed = believed.unwrap_or_else(|more| {
        problems.extend(more);
        None
    });
    let run = run.unwrap_or_else(|more| {
        problems.extend(more);
        None
    });
    if problems.is_empty() {
        problems.extend(plan.iter().flat_map(|plan| case::runs(&studies.cases, (&network, plan))));
    }
    if !problems.is_empty() {
        diagnostics.extend(problems);
        diagnostics.retain(|d| d.severity == Severity::Error);
        return Err(Rejected::arranged(files, diagnostics, 0));
    }
    let inputs = files.ids().collect();
    let mut netlist = Netlist {
        network,
        run,
        studies,
        source_map: Arc::new(map),
        files,
        warnings: Vec::new(),
        written: diagnostics,
        temperature_unit,
        plan,
        initial,
        uncertainty,
        case: None,
        believed,
        assigned,
        inputs,
        structure: done.structure,
        gearboxes,
    };
    netlist.judge();
    Ok(netlist)
}

/// Adds problems that do not depend on the contents of broken lines.
fn add_certain(all: &mut Vec<Diagnostic>, found: Vec<Diagnostic>, (files, file): (&Files, FileId)) {
    let line = |d: &Diagnostic| d.place().map(|span| files.line_column(span).0);
    let broken: HashSet<Option<usize>> = all.iter().map(line).collect();
    // after an unclosed part, the parser mistakes one thing for another
    let end = all
        .iter()
        .filter(|d| d.code == NOT_CLOSED)
        .filter_map(Diagnostic::place)
        .map(|s| s.range.start);
    let end = end.min().unwrap_or(usize::MAX);
    let certain = found.into_iter().filter(|d| {
        d.severity == Severity::Error
            && !rests_on_absence(d.code)
            && d.place().is_some_and(|span| span.file == file && span.range.start < end)
            && !broken.contains(&line(d))
    });
    all.extend(certain);
    arrange(files, all);
}

/// True if a problem is that something is missing: a broken line may contain it.
fn rests_on_absence(code: &str) -> bool {
    let absences = [
        "netlist::missing_format",
        "netlist::missing_field",
        "netlist::no_law",
        "netlist::unknown_node",
        "netlist::unknown_material",
        "netlist::unknown_fluid",
        "netlist::no_property",
        "netlist::no_size",
        "netlist::no_bound",
        "netlist::unknown_name",
        "netlist::run_output",
        "network::no_capacity",
        "network::no_initial_temperature",
        "network::floating_island",
        "network::empty",
    ];
    absences.contains(&code)
}

fn not_text((name, text): (&str, &str), place: Range<usize>, why: &str) -> Rejected {
    let mut files = Files::new();
    let file = files.add(name, text);
    let error = Diagnostic::error("netlist::not_text", format!("this is not a text file: {why}"))
        .at(Span::new(file, place), "")
        .help(
            "a netlist is a TOML file in UTF-8; choose UTF-8 when your editor saves it, and write \
               `degC` if the degree sign is the trouble",
        );
    Rejected { files, diagnostics: vec![error], syntax: true }
}
