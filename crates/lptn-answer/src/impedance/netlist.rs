//! A table or a ladder as a netlist that runs.

use lptn_network::is_name;

use super::chain::Chain;
use super::{Found, ImpedanceAnswer};

/// Name of the boundary at the end of the impedance.
const END: &str = "reference";

impl ImpedanceAnswer {
    /// The table or the ladder as a netlist that runs; `None` if the answer is neither.
    /// It puts 1 W into the port, whose rise is then the impedance.
    pub fn netlist(&self) -> Option<String> {
        let Found::Chain(chain) = &self.found else { return None };
        Some(self.of_chain(chain))
    }

    fn of_chain(&self, chain: &Chain) -> String {
        let port = if is_name(&self.to) && self.to != END { &self.to } else { "port" };
        let title = format!("Impedance of `{}` in {}", self.to, self.input.title());
        let mut text = format!(
            "format = 1\ntitle = {title:?}\n\n[default]\nT0 = \"20 degC\"\n\n[boundary]\n{END} = {{ T = \
             \"20 degC\" }}\n"
        );
        let mut first = port.to_owned();
        if chain.direct > 0.0 {
            first = format!("{port}_1");
            text += &format!(
                "\n[node.{port}]\nmassless = true\n\n[resistor.{port}_direct]\nfrom = \"{port}\"\nto = \
                 \"{first}\"\nR = \"{} K/W\"\n",
                chain.direct
            );
        }
        text += &match &chain.ladder {
            Some(ladder) => rungs(&ladder.rungs, &first),
            None => table(&chain.terms, &first),
        };
        text += &format!("\n[source]\nheat = {{ into = \"{port}\", P = \"1 W\" }}\n");
        text
    }
}

fn table(terms: &[(f64, f64)], name: &str) -> String {
    let column = |unit: &str, of: &dyn Fn(&(f64, f64)) -> f64| {
        let values: Vec<String> =
            terms.iter().map(|term| format!("\"{} {unit}\"", of(term))).collect();
        values.join(", ")
    };
    let (resistances, times) = (column("K/W", &|term| term.0), column("s", &|term| term.1));
    format!("\n[foster.{name}]\nto = \"{END}\"\nR = [{resistances}]\ntau = [{times}]\n")
}

fn rungs(rungs: &[(f64, f64)], first: &str) -> String {
    let name = |k: usize| if k == 0 { first.to_owned() } else { format!("{first}_n{}", k + 1) };
    let mut nodes = String::from("\n[node]\n");
    let mut paths = String::from("\n[resistor]\n");
    for (k, (capacity, resistance)) in rungs.iter().enumerate() {
        nodes += &format!("{} = {{ C = \"{capacity} J/K\" }}\n", name(k));
        let to = if k + 1 < rungs.len() { name(k + 1) } else { END.to_owned() };
        paths += &format!(
            "{first}_R{} = {{ from = \"{}\", to = \"{to}\", R = \"{resistance} K/W\" }}\n",
            k + 1,
            name(k)
        );
    }
    nodes + &paths
}
