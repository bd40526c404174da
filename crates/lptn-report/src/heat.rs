//! The energy balance as a sentence.

use crate::number::{decimals, fixed, prefix};

/// Heat that a source or boundary gave to the network, in J.
#[derive(Clone, Debug, PartialEq)]
pub struct Flow {
    /// Its name.
    pub name: String,
    /// The heat in J; negative if it was taken out.
    pub heat: f64,
}

/// Most terms on one side with their own names; smaller ones are summed up.
const MOST_TERMS: usize = 5;

/// The energy balance in pieces, each of which stays on one line:
/// `in 330.9 kJ`, `= stored 147.8`, `+ bed 128.2`, `+ air 54.9 kJ`.
///
/// Every term is positive: heat that a boundary gave or a node lost is on the left.
/// `turned_over` is the total heat exchanged in J; terms below 1e-9 of it are left out.
pub fn balance(flows: &[Flow], stored: f64, turned_over: f64) -> Vec<String> {
    let floor = 1e-9 * turned_over;
    let mut left: Vec<(&str, f64)> = terms(flows.iter().map(|f| (f.name.as_str(), f.heat)), floor);
    let mut right = terms(std::iter::once(("stored", stored)), floor);
    right.extend(terms(flows.iter().map(|f| (f.name.as_str(), -f.heat)), floor));
    let only_source = left.len() == 1 && stored >= -floor;
    left.extend(terms(std::iter::once(("stored heat", -stored)), floor));
    let total = |side: &[(&str, f64)]| side.iter().map(|term| term.1).sum::<f64>();
    let largest = total(&left).max(total(&right));
    if largest <= 0.0 {
        return vec![none(turned_over)];
    }
    let (scale, letter) = prefix(largest);
    let digits = decimals(largest / scale, 4, 0);
    let number = |heat: f64| fixed(heat / scale, digits);
    let unit = format!("{letter}J");
    let mut pieces = vec![format!("in {} {unit}", number(total(&left)))];
    if !only_source {
        pieces.extend(side(&left, "from", &number));
    }
    pieces.extend(side(&right, "=", &number));
    if let Some(last) = pieces.last_mut().filter(|last| !last.ends_with(&unit)) {
        *last += &format!(" {unit}");
    }
    pieces
}

fn terms<'a>(named: impl Iterator<Item = (&'a str, f64)>, floor: f64) -> Vec<(&'a str, f64)> {
    named.filter(|(_, heat)| *heat > floor).collect()
}

/// `= a 1`, `+ b 2`, `+ 3 others 4`; the largest keep their names.
fn side(terms: &[(&str, f64)], sign: &str, number: &impl Fn(f64) -> String) -> Vec<String> {
    let mut by_size: Vec<f64> = terms.iter().map(|term| term.1).collect();
    by_size.sort_unstable_by(|a, b| b.total_cmp(a));
    let least = by_size.get(MOST_TERMS).copied().unwrap_or(0.0);
    let (named, others): (Vec<_>, Vec<_>) = terms.iter().partition(|term| term.1 > least);
    let mut texts: Vec<String> =
        named.iter().map(|(name, heat)| format!("{name} {}", number(*heat))).collect();
    if !others.is_empty() {
        let sum = others.iter().map(|term| term.1).sum();
        texts.push(format!("{} others {}", others.len(), number(sum)));
    }
    let signs = std::iter::once(sign).chain(std::iter::repeat("+"));
    texts.iter().zip(signs).map(|(text, sign)| format!("{sign} {text}")).collect()
}

fn none(turned_over: f64) -> String {
    if turned_over > 0.0 {
        let (scale, letter) = prefix(turned_over / 2.0);
        let moved = fixed(turned_over / 2.0 / scale, decimals(turned_over / 2.0 / scale, 4, 0));
        return format!("none in or out; {moved} {letter}J moved between nodes");
    }
    "none".to_owned()
}

#[cfg(test)]
mod tests {
    use super::{Flow, balance};

    fn line(flows: &[(&str, f64)], stored: f64) -> String {
        let flows: Vec<Flow> =
            flows.iter().map(|&(name, heat)| Flow { name: name.into(), heat }).collect();
        let turned_over = flows.iter().map(|f| f.heat.abs()).sum::<f64>() + stored.abs();
        balance(&flows, stored, turned_over).join(" ")
    }

    #[test]
    fn heat_of_one_source_is_stored_and_given_off() {
        let flows = [("P", 330_900.0), ("bed", -128_100.0), ("air", -54_900.0)];
        assert_eq!(line(&flows, 147_900.0), "in 330.9 kJ = stored 147.9 + bed 128.1 + air 54.9 kJ");
    }

    #[test]
    fn a_boundary_that_gives_heat_stands_on_the_left() {
        let flows = [("P", 1000.0), ("sun", 500.0), ("air", -1500.0)];
        assert_eq!(line(&flows, 0.0), "in 1.500 kJ from P 1.000 + sun 0.500 = air 1.500 kJ");
    }

    #[test]
    fn a_cooling_network_gives_what_was_stored() {
        assert_eq!(line(&[("air", -2.0)], -2.0), "in 2.000 J from stored heat 2.000 = air 2.000 J");
    }

    #[test]
    fn nothing_happens() {
        assert_eq!(line(&[("P", 0.0)], 0.0), "none");
        assert_eq!(balance(&[], 0.0, 8e4), ["none in or out; 40.00 kJ moved between nodes"]);
    }

    #[test]
    fn small_terms_are_summed_up() {
        let mut flows: Vec<(String, f64)> =
            (0..8).map(|i| (format!("b{i}"), -f64::from(8 - i))).collect();
        flows.push(("P".into(), 36.0));
        let flows: Vec<(&str, f64)> = flows.iter().map(|(n, h)| (n.as_str(), *h)).collect();
        assert_eq!(
            line(&flows, 0.0),
            "in 36.00 J = b0 8.00 + b1 7.00 + b2 6.00 + b3 5.00 + b4 4.00 + 3 others 6.00 J"
        );
    }

    #[test]
    fn noise_beside_large_heat_is_left_out() {
        assert_eq!(
            line(&[("P", 1e6), ("air", -1e6), ("far", -1e-6)], 0.0),
            "in 1.000 MJ = air 1.000 MJ"
        );
    }
}
