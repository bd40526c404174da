//! The verbs of the command line, each in a folder with its options, its work and its page.

pub(crate) mod check;
pub(crate) mod compare;
pub(crate) mod completions;
pub(crate) mod explain;
pub(crate) mod fit;
pub(crate) mod gear;
pub(crate) mod graph;
pub(crate) mod impedance;
pub(crate) mod infer;
pub(crate) mod man;
pub(crate) mod materials;
pub(crate) mod modes;
pub(crate) mod new;
pub(crate) mod plan;
pub(crate) mod plot;
pub(crate) mod rank;
pub(crate) mod reduce;
pub(crate) mod report;
pub(crate) mod run;
pub(crate) mod size;
pub(crate) mod steady;
pub(crate) mod sweep;
pub(crate) mod units;
pub(crate) mod verify;

use std::path::PathBuf;

use clap::{Args, Command, Subcommand};

use crate::console::Console;
use crate::exit::Exit;
use crate::failure::Failure;

/// The verb of what does it, `run` of `run::run`.
fn called(path: &'static str) -> &'static str {
    path.split("::").next().unwrap_or("").trim()
}

/// Names each verb with its options, what does it, and whether there is a picture of its answer.
macro_rules! verbs {
    ($($Verb:ident($($args:ident)::*) => $($does:ident)::*, drawn $drawn:expr;)*) => {
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
                    $(Self::$Verb(_) => called(stringify!($($does)::*)),)*
                }
            }

            /// The parser of the verb that is called this.
            pub(crate) fn parser(name: &str) -> Option<Command> {
                let parsers: &[(&'static str, fn(Command) -> Command)] =
                    &[$((called(stringify!($($does)::*)), <$($args)::* as Args>::augment_args)),*];
                let (name, parser) = parsers.iter().find(|(known, _)| *known == name)?;
                Some(parser(Command::new(*name)))
            }

            /// Whether `--plot` has something to draw.
            pub(crate) fn is_drawn(&self) -> bool {
                match self {
                    $(Self::$Verb(args) => {
                        let drawn: fn(&$($args)::*) -> bool = $drawn;
                        drawn(args)
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
    Run(run::RunArgs) => run::run, drawn |_| true;
    Plot(plot::PlotArgs) => plot::plot, drawn |_| true;
    Report(report::ReportArgs) => report::report, drawn |_| false;
    Steady(steady::SteadyArgs) => steady::steady, drawn |args| args.cycle.periodic;
    Modes(modes::ModesArgs) => modes::modes, drawn |_| true;
    Verify(verify::VerifyArgs) => verify::verify, drawn |_| false;
    Compare(compare::CompareArgs) => compare::compare, drawn |_| true;
    Size(size::SizeArgs) => size::size, drawn |args| args.file.is_some();
    Rank(rank::RankArgs) => rank::rank, drawn |_| true;
    Sweep(sweep::SweepArgs) => sweep::sweep, drawn |args| args.verb.is_none();
    Fit(fit::FitArgs) => fit::fit, drawn |_| true;
    Infer(infer::InferArgs) => infer::infer, drawn |_| true;
    Plan(plan::PlanArgs) => plan::plan, drawn |_| true;
    Reduce(reduce::ReduceArgs) => reduce::reduce, drawn |_| true;
    Impedance(impedance::ImpedanceArgs) => impedance::impedance, drawn |_| true;
    Gear(gear::GearArgs) => gear::gear, drawn |_| true;
    Graph(graph::GraphArgs) => graph::graph, drawn |_| true;
    Check(check::CheckArgs) => check::check, drawn |_| false;
    Explain(explain::ExplainArgs) => explain::explain, drawn |_| false;
    New(new::NewArgs) => new::new, drawn |_| false;
    Units(units::UnitsArgs) => units::units, drawn |_| false;
    Materials(materials::MaterialsArgs) => materials::materials, drawn |_| false;
    Completions(completions::CompletionsArgs) => completions::completions, drawn |_| false;
    Man(man::ManArgs) => man::man, drawn |_| false;
}
