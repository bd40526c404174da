//! A table whose numbers follow from parameters, as a ladder whose elements do.
//!
//! Each number of the table becomes a parameter, `chip.R_1` and `chip.tau_1`, and so does each
//! quotient of the conversion of [`lptn_network::Foster::cauer`], in the order in which that adds
//! the terms. So `--set`, fits, sensitivities and uncertainties need no code for chains. A table of
//! numbers is converted before, since its conversion may sort: other orders than that from fast to
//! slow lose up to 6 of 16 digits (six terms over six decades, all orders, against mpmath).

use lptn_data::Span;
use lptn_units::{Dimension, Type};

use crate::raw::{RawEntry, RawValue};

/// The parameters of a table and the texts of its rungs.
pub(super) struct Written {
    /// The parameters, each after those that it reads.
    pub(super) parameters: Vec<RawEntry>,
    /// The types that some of them have to have.
    pub(super) types: Vec<(String, Type)>,
    /// Heat capacity and resistance of each rung.
    pub(super) rungs: Vec<(String, String)>,
}

/// Names of the quotients `q` and differences `e` of a ladder; the last `e` is 0.
struct Quotients {
    q: Vec<String>,
    e: Vec<String>,
}

struct Writer<'w> {
    /// The name of the chain in the whole netlist, and where it is written.
    key: &'w str,
    here: &'w str,
    at: &'w Span,
    written: Written,
}

impl Written {
    /// Writes a table of (resistance, time constant), at least one.
    pub(super) fn of((key, here): (&str, &str), terms: &[(RawValue, RawValue)], at: &Span) -> Self {
        let written = Self { parameters: Vec::new(), types: Vec::new(), rungs: Vec::new() };
        let mut writer = Writer { key, here, at, written };
        let mut quotients = Quotients { q: Vec::new(), e: Vec::new() };
        let (mut weight, mut last) = (String::new(), String::new());
        for (k, (resistance, tau)) in terms.iter().enumerate() {
            let r = writer.given(format!("R_{}", k + 1), resistance, Dimension::RESISTANCE);
            let tau = writer.given(format!("tau_{}", k + 1), tau, Dimension::TIME);
            let added = format!("{r} / {tau}");
            if k == 0 {
                weight = writer.put("w_1", added);
            } else {
                let moved = writer.put(&format!("d_{k}"), format!("1 / {last} - 1 / {tau}"));
                quotients = writer.moved(quotients, &moved, k);
                let sum = writer.put(&format!("w_{}", k + 1), format!("{weight} + {added}"));
                let shares = [format!("({added} / {sum})"), format!("({weight} / {sum})")];
                quotients = writer.with_pole(quotients, &shares, k + 1);
                weight = sum;
            }
            quotients.q.push(String::new());
            last = tau;
        }
        let moved = format!("(1 / {last})");
        let quotients = writer.moved(quotients, &moved, terms.len());
        writer.ladder(&quotients, &weight);
        writer.written
    }
}

impl Writer<'_> {
    /// A parameter with this text, by its name in other texts.
    fn put(&mut self, name: &str, text: String) -> String {
        self.entry(name, RawValue::text(text, self.at))
    }

    fn entry(&mut self, name: &str, value: RawValue) -> String {
        let entry = RawEntry::new(&format!("{}.{name}", self.key), value);
        self.written.parameters.push(entry);
        format!("{}.{name}", self.here)
    }

    /// A number of the table, which has a dimension.
    fn given(&mut self, name: String, value: &RawValue, dimension: Dimension) -> String {
        self.written.types.push((format!("{}.{name}", self.key), Type::of(dimension)));
        self.entry(&name, value.clone())
    }

    /// All rates become larger by `d`, in the step of this number. A quotient without a name is 0.
    fn moved(&mut self, old: Quotients, d: &str, step: usize) -> Quotients {
        let mut new = Quotients { q: Vec::new(), e: Vec::new() };
        let mut added = d.to_owned();
        for (i, q) in old.q.iter().enumerate() {
            let sum = if q.is_empty() { added.clone() } else { format!("{q} + {added}") };
            let moved = self.put(&format!("p_{step}_{}", i + 1), sum);
            if let Some(e) = old.e.get(i) {
                let other =
                    self.put(&format!("s_{step}_{}", i + 1), format!("{q} * {e} / {moved}"));
                let next = format!("{added} * {e} / {moved} + {d}");
                added = self.put(&format!("d_{step}_{}", i + 2), next);
                new.e.push(other);
            }
            new.q.push(moved);
        }
        new
    }

    /// A pole at rate 0 with this share of the weight; the others have the rest.
    fn with_pole(&mut self, old: Quotients, [share, rest]: &[String; 2], step: usize) -> Quotients {
        let mut new = Quotients { q: Vec::new(), e: Vec::new() };
        let mut fed = format!("{} * {share}", old.q[0]);
        new.q.push(self.put(&format!("q_{step}_1"), format!("{} * {rest}", old.q[0])));
        for (i, e) in old.e.iter().enumerate() {
            let from = self.put(&format!("f_{step}_{}", i + 1), fed);
            let sum = self.put(&format!("e_{step}_{}", i + 1), format!("{e} + {from}"));
            let next = &old.q[i + 1];
            let kept = format!("{next} * {e} / {sum}");
            new.q.push(self.put(&format!("q_{step}_{}", i + 2), kept));
            fed = format!("{next} * {from} / {sum}");
            new.e.push(sum);
        }
        new.e.push(self.put(&format!("e_{step}_{}", old.q.len()), fed));
        new
    }

    fn ladder(&mut self, quotients: &Quotients, weight: &str) {
        let mut text = format!("1 / {weight}");
        for (i, q) in quotients.q.iter().enumerate() {
            let capacity = self.put(&format!("C_{}", i + 1), text);
            self.written.rungs.push((capacity.clone(), format!("1 / ({q} * {capacity})")));
            text =
                quotients.e.get(i).map_or_else(String::new, |e| format!("{q} * {capacity} / {e}"));
        }
    }
}
