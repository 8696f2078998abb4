//! What an EXR tells of how its picture came about, and of what its layers hold, under the prefix `luch/`.

use super::attributes::text;
use crate::film::{COMPONENTS, Film, Layer, Quantity};
use crate::output::{Fact, Header};
use exr::meta::attribute::AttributeValue;
use exr::meta::header::LayerAttributes;

/// Adds the facts of the header, and of the film's layers their names, units and sums.
pub(super) fn describe(film: &Film, header: &Header, attributes: &mut LayerAttributes) {
    let mut add = |name: &str, value| {
        let name = text(&format!("luch/{name}"));
        attributes.other.insert(name, value);
    };
    for (name, fact) in &header.facts {
        let value = match fact {
            Fact::Text(words) => AttributeValue::Text(text(words)),
            Fact::Number(number) => AttributeValue::F64(*number),
        };
        add(name, value);
    }
    let names: Vec<String> = film.layers.iter().map(name_of).collect();
    add("layers", AttributeValue::Text(text(&names.join(", "))));
    for layer in film.layers.iter().filter(|layer| !is_part(layer)) {
        let unit = AttributeValue::Text(text(layer.unit));
        add(&format!("unit/{}", name_of(layer)), unit);
    }
    for (name, whole, is_summand) in SUMS {
        let parts = film.layers.iter().filter(|layer| is_part(layer));
        let summands = parts
            .map(|layer| &*layer.name)
            .filter(|name| is_summand(name));
        let summands: Vec<&str> = summands.collect();
        if !summands.is_empty() {
            let sum = format!("{whole} = {}", summands.join(" + "));
            add(&format!("sum/{name}"), AttributeValue::Text(text(&sum)));
        }
    }
}

/// A kind of sum, what it adds up to, and which parts of light are in it.
type Sum = (&'static str, &'static str, fn(&str) -> bool);

const SUMS: [Sum; 3] = [
    ("components", BEAUTY_NAME, |name| COMPONENTS.contains(&name)),
    ("lights", BEAUTY_NAME, |name| name.starts_with("light_")),
    ("bounces", "reflection", |name| {
        name.starts_with("reflection_")
    }),
];

const BEAUTY_NAME: &str = "beauty";

fn is_part(layer: &Layer) -> bool {
    matches!(layer.quantity, Quantity::Part(_))
}

/// What a layer is called where all of them are listed.
fn name_of(layer: &Layer) -> String {
    match (layer.quantity, &*layer.name) {
        (Quantity::Light, _) => BEAUTY_NAME.to_owned(),
        (_, "") => layer.channels.concat(),
        (_, name) => name.to_owned(),
    }
}
