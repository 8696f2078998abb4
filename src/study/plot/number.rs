//! Numbers as plots and tables write them.

/// A power of a thousand and its prefix.
const PREFIXES: [(i32, &str); 9] = [
    (-12, "p"),
    (-9, "n"),
    (-6, "µ"),
    (-3, "m"),
    (0, ""),
    (3, "k"),
    (6, "M"),
    (9, "G"),
    (12, "T"),
];

/// Keeps a number and its unit on one line.
const SPACE: char = '\u{a0}';

/// What stands before numbers below zero, as wide as a plus.
const MINUS: char = '\u{2212}';

/// Whether SI prefixes go with `unit`.
pub(super) fn takes_prefixes(unit: &str) -> bool {
    matches!(unit, "s" | "B")
}

/// `value` with `digits` significant digits, without trailing zeros, and the prefix of its thousand: "1.5 k", "10 ms".
///
/// A unit that takes no prefixes is left to the caller, and small values keep their decimals.
pub(in crate::study) fn engineering(value: f64, unit: &str, digits: i32) -> String {
    let prefixed = takes_prefixes(unit);
    if value == 0.0 || !value.is_finite() {
        let number = if value == 0.0 {
            "0".into()
        } else {
            "–".into()
        };
        return joined(number, if prefixed { unit } else { "" });
    }
    let exponent = decade(value, digits);
    let plain = !prefixed && (-3..3).contains(&exponent) || unit == "%";
    let thousand = if plain { 0 } else { exponent.div_euclid(3) * 3 };
    let (thousand, prefix) = match PREFIXES.iter().find(|(power, _)| *power == thousand) {
        Some(&found) => found,
        None => return scientific(value, if prefixed { unit } else { "" }, digits),
    };
    let decimals = (digits - 1 - (exponent - thousand)).max(0);
    let number = trimmed(value / power_of_ten(thousand), decimals as usize);
    joined(
        number,
        &format!("{prefix}{}", if prefixed { unit } else { "" }),
    )
}

/// `value` with `decimals` decimals and thin spaces between thousands, for tables.
pub(in crate::study) fn thousands(value: f64, decimals: usize) -> String {
    if !value.is_finite() {
        return "–".into();
    }
    if value.abs() >= 1e15 {
        return scientific(value, "", 4);
    }
    // A table of hundreds of decimals is a mistake of the caller; a double has seventeen digits.
    let text = format!("{:.*}", decimals.min(17), value.abs());
    let (whole, fraction) = text.split_once('.').unwrap_or((&text, ""));
    let mut out = String::new();
    if value < 0.0 && text.bytes().any(|byte| (b'1'..=b'9').contains(&byte)) {
        out.push(MINUS);
    }
    for (i, digit) in whole.chars().enumerate() {
        if i > 0 && (whole.len() - i).is_multiple_of(3) && whole.len() > 4 {
            out.push('\u{202f}');
        }
        out.push(digit);
    }
    if !fraction.is_empty() {
        out.push('.');
        out.push_str(fraction);
    }
    out
}

fn scientific(value: f64, unit: &str, digits: i32) -> String {
    let exponent = decade(value, digits);
    let mantissa = trimmed(value / power_of_ten(exponent), (digits - 1).max(0) as usize);
    joined(format!("{mantissa}e{exponent}"), unit)
}

/// The power of ten of `value`'s first digit, once it is rounded to `digits` digits: 9.99 with two of them is 10.
pub(super) fn decade(value: f64, digits: i32) -> i32 {
    let exponent = libm::floor(libm::log10(value.abs())) as i32;
    let scaled = value.abs() / power_of_ten(exponent);
    let unit = power_of_ten(1 - digits);
    exponent + i32::from((scaled / unit).round() * unit >= 10.0 - unit / 2.0)
}

pub(super) fn power_of_ten(exponent: i32) -> f64 {
    libm::exp10(f64::from(exponent))
}

fn trimmed(value: f64, decimals: usize) -> String {
    let mut text = format!("{:.decimals$}", value.abs());
    if text.contains('.') {
        text.truncate(text.trim_end_matches('0').trim_end_matches('.').len());
    }
    if value < 0.0 && text != "0" {
        text.insert(0, MINUS);
    }
    text
}

fn joined(number: String, unit: &str) -> String {
    if unit.is_empty() {
        number
    } else {
        format!("{number}{SPACE}{unit}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_take_the_prefix_of_their_thousand() {
        for (value, unit, expected) in [
            (1000.0, "", "1\u{a0}k"),
            (10_000.0, "", "10\u{a0}k"),
            (1.5e6, "", "1.5\u{a0}M"),
            (0.01, "s", "10\u{a0}ms"),
            (1.0, "s", "1\u{a0}s"),
            (2.5e-4, "s", "250\u{a0}µs"),
            (0.0, "s", "0\u{a0}s"),
            (0.01, "", "0.01"),
            (-0.5, "", "\u{2212}0.5"),
            (2e-5, "", "20\u{a0}µ"),
            (999.9, "", "1\u{a0}k"),
            (64e9, "B", "64\u{a0}GB"),
            (1e21, "", "1e21"),
            (f64::NAN, "", "–"),
        ] {
            assert_eq!(engineering(value, unit, 3), expected, "{value} {unit}");
        }
    }

    #[test]
    fn tables_group_thousands_and_never_show_a_minus_zero() {
        assert_eq!(thousands(1234567.0, 0), "1\u{202f}234\u{202f}567");
        assert_eq!(thousands(1234.0, 1), "1234.0");
        assert_eq!(thousands(-12345.678, 2), "\u{2212}12\u{202f}345.68");
        assert_eq!(thousands(-0.001, 1), "0.0");
        assert_eq!(thousands(f64::INFINITY, 1), "–");
        assert_eq!(thousands(1e300, 1), "1e300");
    }
}
