//! The report of a study: one page, complete in itself.

mod escape;
mod page;
mod table;

pub(super) use escape::escape;

use super::plot::Plot;

/// What a study found, in the order in which the page tells it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// What was studied.
    pub title: String,
    /// The study was interrupted: the page says so before all else.
    pub partial: bool,
    /// The answers, a sentence each. The first one leads.
    pub findings: Vec<String>,
    /// Names and values of what a measurement depends on: machine, kernel, compiler, commit, command, the model's hash.
    pub circumstances: Vec<(String, String)>,
    /// What makes results doubtful, in words: failures, outliers, a busy machine.
    pub warnings: Vec<String>,
    /// Shown first.
    pub plots: Vec<Plot>,
    /// Shown after the plots.
    pub pictures: Vec<Picture>,
    /// Shown last.
    pub tables: Vec<Table>,
    /// Command lines that do it again.
    pub repeat: Vec<String>,
}

/// A picture with what it shows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Picture {
    /// What it shows, in a few words.
    pub name: String,
    /// Consecutive pictures of one group stand side by side; an empty group is each picture's own.
    pub group: String,
    /// What to see in it.
    pub caption: String,
    /// The file's bytes.
    pub png: Vec<u8>,
}

/// Rows of values, which readers sort by any column.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// What it lists.
    pub title: String,
    /// From left to right.
    pub columns: Vec<Column>,
    /// As many cells each as there are columns; fewer leave the last ones empty, more are not shown.
    pub rows: Vec<Vec<Cell>>,
}

/// The head of a column.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Column {
    /// What stands in it.
    pub name: String,
    /// May be empty.
    pub unit: String,
}

/// A value in a table.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// A name or a word.
    Text(String),
    /// A number and with how many decimals it is shown. What is not finite is shown as a dash, and sorted last.
    Number(f64, usize),
}

/// `report` as a page that needs no other file and no network.
pub fn html(report: &Report) -> String {
    page::html(report)
}
