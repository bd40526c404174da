//! Format and destination of a drawing.

use std::path::{Path, PathBuf};

use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::graph::Kind;
use lptn_netlist::Diagnostic;

/// Destination of a drawing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Place {
    Stdout,
    File(PathBuf),
    /// Among the results of the network, under a usual name.
    Results,
}

/// Format and destination by `--format` and `-o`.
/// `only` is an output that can only be a picture, and the option that asks for it.
pub(super) fn wanted(
    format: Option<Kind>,
    output: Option<&Path>,
    only: Option<[&str; 2]>,
) -> Result<(Kind, Place), Failure> {
    let (kind, place) = match (format, output) {
        (format, None) => {
            let kind = format.unwrap_or(Kind::Svg);
            (kind, if kind.is_piped() { Place::Stdout } else { Place::Results })
        }
        (format, Some(path)) if path.as_os_str() == "-" => {
            (format.unwrap_or(Kind::Svg), Place::Stdout)
        }
        (format, Some(path)) => {
            let kind = match (format, Kind::of_ending(path)) {
                (Some(format), Some(of_file)) if format != of_file => {
                    return Err(contradiction(path, format, of_file));
                }
                (Some(kind), _) | (None, Some(kind)) => kind,
                (None, None) => return Err(no_format(path)),
            };
            (kind, Place::File(path.to_owned()))
        }
    };
    match only.filter(|_| !matches!(kind, Kind::Svg | Kind::Png)) {
        None => Ok((kind, place)),
        Some([what, option]) => {
            let whole = if kind.is_of_grid() { "the whole grid" } else { "the network" };
            let message = format!("{what} is a picture, but {} contains {whole}", kind.key());
            let problem = Diagnostic::error("graph::format", message);
            Err(refused(problem.help(format!("leave {option} out, or write svg or png"))))
        }
    }
}

fn refused(problem: Diagnostic) -> Failure {
    Failure::new(Exit::Input, problem)
}

fn contradiction(path: &Path, format: Kind, of_file: Kind) -> Failure {
    let message = format!(
        "--format {} does not fit {}, which ends as {} does",
        format.key(),
        path.display(),
        of_file.key()
    );
    let help = format!("leave --format out, or let the name end with .{}", format.ending());
    refused(Diagnostic::error("graph::format", message).help(help))
}

fn no_format(path: &Path) -> Failure {
    let message = format!("cannot read the format from {}", path.display());
    let help = "end it with .svg, .png, .dot, .mmd, .vtk or .csv, or add --format svg";
    refused(Diagnostic::error("graph::format", message).help(help))
}
