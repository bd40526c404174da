//! The verbs of the command line, each in a folder with its options, its work and its page.

pub(crate) mod check;
pub(crate) mod compare;
pub(crate) mod completions;
pub(crate) mod fit;
pub(crate) mod graph;
pub(crate) mod man;
pub(crate) mod materials;
pub(crate) mod modes;
pub(crate) mod new;
pub(crate) mod plot;
pub(crate) mod reduce;
pub(crate) mod report;
pub(crate) mod run;
pub(crate) mod size;
pub(crate) mod steady;
pub(crate) mod units;
pub(crate) mod verify;

use std::path::PathBuf;

use clap::Subcommand;

use crate::console::Console;
use crate::exit::Exit;
use crate::failure::Failure;

/// Names each verb with its options and what does it.
macro_rules! verbs {
    ($($Verb:ident($($args:ident)::*) => $($does:ident)::*,)*) => {
        /// What is to be done.
        #[derive(Debug, Subcommand)]
        pub(crate) enum Verb {
            $($Verb($($args)::*),)*
        }

        impl Verb {
            /// Where the report goes that it is there to write.
            pub(crate) fn report(&self) -> Option<Option<PathBuf>> {
                match self {
                    Self::Report(args) => Some(args.output.clone()),
                    _ => None,
                }
            }

            /// What it is called on the command line.
            pub(crate) fn name(&self) -> &'static str {
                match self {
                    $(Self::$Verb(_) => stringify!($($does)::*).split("::").next().unwrap_or("").trim(),)*
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
    Run(run::RunArgs) => run::run,
    Plot(plot::PlotArgs) => plot::plot,
    Report(report::ReportArgs) => report::report,
    Steady(steady::SteadyArgs) => steady::steady,
    Modes(modes::ModesArgs) => modes::modes,
    Verify(verify::VerifyArgs) => verify::verify,
    Compare(compare::CompareArgs) => compare::compare,
    Size(size::SizeArgs) => size::size,
    Fit(fit::FitArgs) => fit::fit,
    Reduce(reduce::ReduceArgs) => reduce::reduce,
    Graph(graph::GraphArgs) => graph::graph,
    Check(check::CheckArgs) => check::check,
    New(new::NewArgs) => new::new,
    Units(units::UnitsArgs) => units::units,
    Materials(materials::MaterialsArgs) => materials::materials,
    Completions(completions::CompletionsArgs) => completions::completions,
    Man(man::ManArgs) => man::man,
}
