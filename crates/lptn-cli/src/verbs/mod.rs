//! The verbs of the command line, each in a folder with its options, its work and its page.

pub(crate) mod check;
pub(crate) mod compare;
pub(crate) mod explain;
pub(crate) mod fit;
pub(crate) mod gear;
pub(crate) mod graph;
pub(crate) mod groups;
pub(crate) mod impedance;
pub(crate) mod infer;
pub(crate) mod materials;
pub(crate) mod modes;
pub(crate) mod new;
pub(crate) mod plan;
pub(crate) mod plot;
pub(crate) mod rank;
pub(crate) mod reduce;
pub(crate) mod report;
pub(crate) mod run;
pub(crate) mod schema;
pub(crate) mod setup;
pub(crate) mod size;
pub(crate) mod steady;
pub(crate) mod sweep;
pub(crate) mod units;
pub(crate) mod verify;

use std::path::PathBuf;

use clap::{Args, Command, Subcommand};

use crate::console::Console;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;

/// The verb of the function that does it, `run` of `run::run`.
fn called(path: &'static str) -> &'static str {
    path.rsplit("::").next().unwrap_or("").trim()
}

/// Lists each verb with its options and its function.
/// Conditions say if it has a page and a picture; a picture has a name.
macro_rules! verbs {
    ($(
        $(#[$attribute:meta])*
        $Verb:ident($($args:ident)::*) => $($does:ident)::*,
        page $paged:expr, drawn $words:literal $drawn:expr;
    )*) => {
        /// Verbs whose answer has a picture.
        pub(crate) const DRAWN: &[&str] = &[$($words),*];

        /// What is to be done.
        #[derive(Debug, Subcommand)]
        pub(crate) enum Verb {
            $($(#[$attribute])* $Verb($($args)::*),)*
        }

        impl Verb {
            /// File of the report, for the verb that writes only that, with the one of `--report`.
            pub(crate) fn report(&self, named: Option<&PathBuf>) -> Option<Option<PathBuf>> {
                match self {
                    Self::Report(args) => Some(args.output.as_ref().or(named).cloned()),
                    _ => None,
                }
            }

            /// The option for the file of the only thing that the verb writes, if it is given, and
            /// the one of all verbs for the same.
            pub(crate) fn names_its_file(&self) -> Option<&'static str> {
                match self {
                    Self::Report(args) if args.output.is_some() => Some("--report"),
                    Self::Plot(args) if args.output.is_some() => Some("--plot"),
                    _ => None,
                }
            }

            /// Its name on the command line.
            pub(crate) fn name(&self) -> &'static str {
                match self {
                    $(Self::$Verb(_) => called(stringify!($($does)::*)),)*
                }
            }

            /// The parser of the verb of this name.
            pub(crate) fn parser(name: &str) -> Option<Command> {
                let parsers: &[(&'static str, fn(Command) -> Command)] =
                    &[$((called(stringify!($($does)::*)), <$($args)::* as Args>::augment_args)),*];
                let (name, parser) = parsers.iter().find(|(known, _)| *known == name)?;
                Some(parser(Command::new(*name)))
            }

            /// True if `--plot` has something to draw.
            pub(crate) fn is_drawn(&self) -> bool {
                match self {
                    $(Self::$Verb(args) => {
                        let drawn: fn(&$($args)::*) -> bool = $drawn;
                        drawn(args)
                    })*
                }
            }

            /// True if `--report` has something to write.
            pub(crate) fn is_reported(&self) -> bool {
                match self {
                    $(Self::$Verb(args) => {
                        let paged: fn(&$($args)::*) -> bool = $paged;
                        paged(args)
                    })*
                }
            }

            /// Does it.
            pub(crate) fn run(&self, console: &Console) -> Result<Exit, Failure> {
                match self {
                    $(Self::$Verb(args) => $($does)::*(args, console),)*
                }
            }
        }
    };
}

verbs! {
    Run(run::RunArgs) => run::run, page |_| true, drawn "run" |_| true;
    Plot(plot::PlotArgs) => plot::plot, page |_| true, drawn "plot" |_| true;
    Report(report::ReportArgs) => report::report, page |_| true, drawn "" |_| false;
    Steady(steady::SteadyArgs) => steady::steady, page |_| true, drawn "steady --periodic" |args| args.cycle.periodic;
    Modes(modes::ModesArgs) => modes::modes, page |_| true, drawn "modes" |_| true;
    Verify(verify::VerifyArgs) => verify::verify, page |_| true, drawn "" |_| false;
    Compare(compare::CompareArgs) => compare::compare, page |_| true, drawn "compare" |_| true;
    Size(size::SizeArgs) => size::size, page |_| true, drawn "size" |args| args.file.is_some();
    Rank(rank::RankArgs) => rank::rank, page |_| true, drawn "rank" |_| true;
    Sweep(sweep::SweepArgs) => sweep::sweep, page |_| true, drawn "sweep" |args| args.verb.is_none();
    Fit(fit::FitArgs) => fit::fit, page |_| true, drawn "fit" |_| true;
    Infer(infer::InferArgs) => infer::infer, page |_| true, drawn "infer" |_| true;
    Plan(plan::PlanArgs) => plan::plan, page |_| true, drawn "plan" |_| true;
    Reduce(reduce::ReduceArgs) => reduce::reduce, page |_| true, drawn "reduce" |_| true;
    Impedance(impedance::ImpedanceArgs) => impedance::impedance, page |_| true, drawn "impedance" |_| true;
    Gear(gear::GearArgs) => gear::gear, page |_| true, drawn "gear" |_| true;
    Graph(graph::GraphArgs) => graph::graph, page |_| false, drawn "" |_| true;
    Check(check::CheckArgs) => check::check, page |args| !args.expand, drawn "" |_| false;
    Explain(explain::ExplainArgs) => explain::explain, page |_| true, drawn "" |_| false;
    New(new::NewArgs) => new::new, page |_| false, drawn "" |_| false;
    Units(units::UnitsArgs) => units::units, page |_| true, drawn "" |_| false;
    Materials(materials::MaterialsArgs) => materials::materials, page |_| true, drawn "" |_| false;
    Schema(schema::SchemaArgs) => schema::schema, page |_| false, drawn "" |_| false;
    Setup(setup::SetupArgs) => setup::setup, page |_| false, drawn "" |_| false;
    #[command(hide = true)]
    Completions(setup::CompletionsArgs) => setup::former::completions, page |_| false, drawn "" |_| false;
    #[command(hide = true)]
    Man(setup::ManArgs) => setup::former::man, page |_| false, drawn "" |_| false;
}
