//! What is said of a case: one line for each of its quantities.

use std::fmt;

use super::case::Case;
use super::expected::Expected;
use super::proof::Proof;

/// What is said of one value.
#[derive(Clone, Debug)]
pub enum Verdict {
    /// It is right; the error as a share of what is allowed.
    Right(f64),
    /// It is wrong, or was not found.
    Wrong(String),
}

impl Verdict {
    pub fn of(found: f64, expected: &Expected) -> Self {
        let (error, allowed) = ((found - expected.value).abs(), expected.allowed());
        if error <= allowed {
            Self::Right(if allowed > 0.0 { error / allowed } else { 0.0 })
        } else {
            // a NaN comes here too
            Self::Wrong(format!("found {found}, {:.3} of what is allowed", error / allowed))
        }
    }
}

/// What is said of one quantity of a case.
#[derive(Clone, Debug)]
struct Line {
    quantity: String,
    right: usize,
    wrong: usize,
    /// The largest error as a share of what is allowed, and what is allowed there.
    worst: (f64, f64),
}

/// What is said of a case.
#[derive(Clone, Debug)]
pub struct Report {
    pub id: String,
    lines: Vec<Line>,
    complaints: Vec<String>,
    tolerance: f64,
    pub proof: Proof,
}

impl Report {
    pub fn new(id: &str, case: &Case) -> Self {
        Self {
            id: id.to_owned(),
            lines: Vec::new(),
            complaints: Vec::new(),
            tolerance: case.tolerance(),
            proof: None,
        }
    }

    pub fn unreadable(id: &str, why: &str) -> Self {
        let complaints = vec![format!("{id}: {why}")];
        Self { id: id.to_owned(), lines: Vec::new(), complaints, tolerance: f64::NAN, proof: None }
    }

    pub fn complain(&mut self, what: String) {
        self.complaints.push(format!("{}: {what}", self.id));
    }

    pub fn add(&mut self, expected: &Expected, verdict: Verdict) {
        let i = self.lines.iter().position(|line| line.quantity == expected.name).unwrap_or_else(
            || {
                let quantity = expected.name.clone();
                self.lines.push(Line {
                    quantity,
                    right: 0,
                    wrong: 0,
                    worst: (0.0, expected.allowed()),
                });
                self.lines.len() - 1
            },
        );
        let line = &mut self.lines[i];
        match verdict {
            Verdict::Right(share) => {
                line.right += 1;
                if share >= line.worst.0 {
                    line.worst = (share, expected.allowed());
                }
            }
            Verdict::Wrong(why) => {
                line.wrong += 1;
                self.complain(format!("{why}: {expected:?}"));
            }
        }
    }

    /// What is wrong, one line each.
    pub fn complaints(&self) -> &[String] {
        &self.complaints
    }

    /// Values that are right and that are wrong.
    pub fn counts(&self) -> [usize; 2] {
        let sum = |of: fn(&Line) -> usize| self.lines.iter().map(of).sum();
        [sum(|line| line.right), sum(|line| line.wrong)]
    }

    /// The largest error of a value that is right, as a share of what is allowed.
    pub fn worst(&self) -> f64 {
        self.lines.iter().map(|line| line.worst.0).fold(0.0, f64::max)
    }

    /// The quantities that were asked for.
    pub fn quantities(&self) -> impl Iterator<Item = &str> {
        self.lines.iter().map(|line| line.quantity.as_str())
    }

    /// The heading of the table.
    pub fn heading() -> String {
        format!(
            "{:<26} {:<18} {:>4} {:>9} {:>9} {:>8}",
            "case", "quantity", "n", "worst/tol", "tolerance", "run at"
        )
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for line in &self.lines {
            let n = line.right + line.wrong;
            write!(f, "{:<26} {:<18} {n:>4} ", self.id, line.quantity)?;
            match line {
                Line { wrong: 1.., .. } => write!(f, "{:>9} ", "WRONG")?,
                _ => write!(f, "{:>9.2e} ", line.worst.0)?,
            }
            writeln!(f, "{:>9.1e} {:>6.0e} K", line.worst.1, self.tolerance)?;
        }
        Ok(())
    }
}
