//! The value of an edge's or source's field that brings a node to a temperature in steady state.

use lptn_network::End;
use serde_json::Value;

use super::answer::{Laboratory, Trouble};
use super::case::Case;
use super::expected::Quantity;

/// Halvings of the range: it is narrowed to neighbouring numbers.
const HALVINGS: usize = 200;

/// Bisection over whole networks, each built anew with the value in its place.
pub fn answer(laboratory: &Laboratory<'_>, quantity: &Quantity) -> Result<f64, Trouble> {
    let Quantity::Size { edge, source, field, node, limit, lo, hi } = quantity else {
        return Err("nothing to size".into());
    };
    let (list, id) = match (edge, source) {
        (Some(edge), None) => ("edges", edge),
        (None, Some(source)) => ("sources", source),
        _ => return Err("what is to be sized, an edge or a source?".into()),
    };
    let excess = |value: f64| -> Result<f64, Trouble> {
        let mut json = laboratory.json.clone();
        let elements = json[list].as_array_mut().ok_or("no list")?;
        let element = elements.iter_mut().find(|e| e["id"] == id.as_str());
        let place = element
            .and_then(|e| e.get_mut(field))
            .ok_or_else(|| format!("no `{field}` of `{id}`"))?;
        *place = Value::from(value);
        let case: Case = serde_json::from_value(json.clone())?;
        let changed = Laboratory::new(&case, &json)?;
        let End::Node(node) = changed.end_named(node)? else {
            return Err("a boundary cannot be sized".into());
        };
        Ok(changed.steady()?.temperatures[node.index()] - case.zero() - limit)
    };
    let (mut low, mut high) = (*lo, *hi);
    let below = excess(low)? < 0.0;
    if (excess(high)? < 0.0) == below {
        return Err(format!("no value from {lo} to {hi} brings it to {limit}").into());
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if (excess(middle)? < 0.0) == below { low = middle } else { high = middle }
    }
    Ok(0.5 * (low + high))
}
