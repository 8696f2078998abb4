//! Tables with heads that sort them.

use super::{Cell, Column, Table, escape};
use crate::study::plot::thousands;
use std::fmt::Write;

/// `table` with its title, in a box of its own that scrolls.
pub(super) fn html(table: &Table) -> String {
    let title = escape(&table.title);
    let mut out = format!(
        "<section class=\"table\">\n<h3>{title}</h3>\n\
         <div class=\"scroll\" role=\"region\" aria-label=\"{title}\" tabindex=\"0\">\n<table>\n<thead><tr>"
    );
    for (i, column) in table.columns.iter().enumerate() {
        out += &head(column, is_numeric(table, i));
    }
    out += "</tr></thead>\n<tbody>\n";
    for row in &table.rows {
        out += "<tr>";
        for i in 0..table.columns.len() {
            out += &cell(row.get(i), is_numeric(table, i));
        }
        out += "</tr>\n";
    }
    out + "</tbody>\n</table>\n</div>\n</section>\n"
}

/// Whether a column's values are numbers: it is set to the right.
fn is_numeric(table: &Table, column: usize) -> bool {
    let mut cells = table.rows.iter().filter_map(|row| row.get(column));
    cells.any(|cell| matches!(cell, Cell::Number(..)))
}

fn head(column: &Column, numeric: bool) -> String {
    let class = if numeric { " class=\"number\"" } else { "" };
    let name = escape(&column.name);
    let unit = match column.unit.as_str() {
        "" => String::new(),
        unit => format!(" <span class=\"unit\">{}</span>", escape(unit)),
    };
    format!(
        "<th scope=\"col\"{class} aria-sort=\"none\"><button type=\"button\">{name}{unit}</button></th>"
    )
}

fn cell(cell: Option<&Cell>, numeric: bool) -> String {
    let class = if numeric { " class=\"number\"" } else { "" };
    match cell {
        None => format!("<td{class}></td>"),
        Some(Cell::Text(text)) => format!("<td{class}>{}</td>", escape(text)),
        Some(Cell::Number(value, decimals)) => {
            let mut out = format!("<td{class}");
            if value.is_finite() {
                // Writing to a string cannot fail.
                write!(out, " data-value=\"{value:e}\"").ok();
            }
            out + &format!(">{}</td>", thousands(*value, *decimals))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> Table {
        Table {
            title: "a <b>".into(),
            columns: vec![
                Column {
                    name: "name".into(),
                    unit: String::new(),
                },
                Column {
                    name: "time".into(),
                    unit: "ms".into(),
                },
            ],
            rows: vec![
                vec![
                    Cell::Text("</td><script>".into()),
                    Cell::Number(12345.678, 1),
                ],
                vec![Cell::Text("short".into())],
                vec![
                    Cell::Text("none".into()),
                    Cell::Number(f64::NAN, 1),
                    Cell::Text("too many".into()),
                ],
            ],
        }
    }

    #[test]
    fn names_from_files_stay_text() {
        let html = html(&table());
        assert!(
            html.contains("<td>&lt;/td&gt;&lt;script&gt;</td>")
                && html.contains("<h3>a &lt;b&gt;</h3>")
        );
        assert!(!html.contains("<script>"));
    }

    #[test]
    fn every_row_has_a_cell_for_every_column_and_numbers_keep_all_their_digits() {
        let html = html(&table());
        assert_eq!(html.matches("<td").count(), 6);
        assert!(
            html.contains("data-value=\"1.2345678e4\">12\u{202f}345.7</td>"),
            "{html}"
        );
        assert!(html.contains("<td class=\"number\">–</td>"));
        assert!(!html.contains("too many"));
    }
}
