//! A table of a scene file: every access names the key and its line where it fails.

use super::kind::{self, Kind};
use super::nearest::suggestion;
use super::source::{Source, quoted};
use crate::Error;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A kind of table: what it is called and which keys it may have.
pub(super) struct Schema {
    /// Its key in the table above.
    pub(super) key: &'static str,
    /// What errors call it, as in `[[sphere]]`.
    pub(super) label: &'static str,
    /// Every key that is known.
    pub(super) keys: &'static [&'static str],
}

/// A table whose keys are all known.
#[derive(Clone, Copy)]
pub(super) struct Table<'a> {
    source: &'a Source<'a>,
    label: &'static str,
    /// Where its header stands, in bytes.
    at: usize,
    entries: &'a DeTable<'a>,
}

impl<'a> Table<'a> {
    /// The whole document.
    pub(super) fn root(
        source: &'a Source<'a>,
        entries: &'a DeTable<'a>,
        known: &[&str],
    ) -> Result<Table<'a>, Error> {
        let root = Table {
            source,
            label: "a scene file",
            at: 0,
            entries,
        };
        root.with_known_keys(known)
    }

    /// The table at `schema.key`, where there is one.
    pub(super) fn table(&self, schema: &Schema) -> Result<Option<Table<'a>>, Error> {
        let Some(value) = self.entries.get(schema.key) else {
            return Ok(None);
        };
        match value.get_ref() {
            DeValue::Table(_) => self.inner(schema, value).map(Some),
            _ => Err(self.error(
                schema.key,
                format!(
                    "{} is {}, expected one {}",
                    schema.key,
                    self.found(value),
                    schema.label
                ),
            )),
        }
    }

    /// Every table of the list at `schema.key`; none where there is no such key.
    pub(super) fn tables(&self, schema: &Schema) -> Result<Vec<Table<'a>>, Error> {
        let Some(value) = self.entries.get(schema.key) else {
            return Ok(Vec::new());
        };
        match value.get_ref() {
            DeValue::Array(items) => items.iter().map(|item| self.inner(schema, item)).collect(),
            _ => Err(self.not_a_list(schema, value)),
        }
    }

    /// The value at `key`, where there is one.
    pub(super) fn optional<T>(&self, key: &str, kind: &Kind<T>) -> Result<Option<T>, Error> {
        match self.entries.get(key) {
            None => Ok(None),
            Some(value) => match (kind.read)(value.get_ref()) {
                Some(value) => Ok(Some(value)),
                None => Err(self.wrong(key, kind.expected)),
            },
        }
    }

    /// The value at `key`, or `default`.
    pub(super) fn or<T>(&self, key: &str, kind: &Kind<T>, default: T) -> Result<T, Error> {
        Ok(self.optional(key, kind)?.unwrap_or(default))
    }

    /// The value at `key`, which must be there.
    pub(super) fn required<T>(&self, key: &str, kind: &Kind<T>) -> Result<T, Error> {
        self.optional(key, kind)?
            .ok_or_else(|| self.missing(key, kind.expected))
    }

    /// The value that the word at `key` stands for, where there is one.
    pub(super) fn choice<T: Copy>(
        &self,
        key: &str,
        choices: &[(&str, T)],
    ) -> Result<Option<T>, Error> {
        let words = || choices.iter().map(|&(word, _)| word);
        let Some(value) = self.entries.get(key) else {
            return Ok(None);
        };
        let Some(found) = value.get_ref().as_str() else {
            return Err(self.wrong(key, &kind::one_of(words())));
        };
        match choices.iter().find(|&&(word, _)| word == found) {
            Some(&(_, choice)) => Ok(Some(choice)),
            None => {
                let expected = kind::one_of(words()) + &suggestion(found, words());
                Err(self.wrong(key, &expected))
            }
        }
    }

    /// Whether there is a value at `key`.
    pub(super) fn has(&self, key: &str) -> bool {
        self.entries.contains_key(key)
    }

    /// The keys that are there, in the file's order.
    pub(super) fn keys(&self) -> Vec<&'a str> {
        let mut keys: Vec<_> = self.entries.keys().collect();
        keys.sort_by_key(|key| key.span().start);
        keys.into_iter().map(|key| key.get_ref().as_ref()).collect()
    }

    /// Where the header stands, in bytes.
    pub(super) fn at(&self) -> usize {
        self.at
    }

    /// The line of the byte `at`, from 1. Takes the time to count: for errors alone.
    pub(super) fn line(&self, at: usize) -> usize {
        self.source.line(at)
    }

    /// An error at `key`, or at the header where there is no such key.
    pub(super) fn error(&self, key: &str, problem: impl Into<String>) -> Error {
        let key_at = self
            .entries
            .get_key_value(key)
            .map(|(key, _)| key.span().start);
        self.source.error(key_at.unwrap_or(self.at), problem)
    }

    /// The error that the value at `key` is not what was expected.
    pub(super) fn wrong(&self, key: &str, expected: &str) -> Error {
        let found = self.entries.get(key).map(|value| self.found(value));
        let problem = format!(
            "{key} in {} is {}, expected {expected}",
            self.label,
            found.unwrap_or_default()
        );
        self.error(key, problem)
    }

    /// The error that there is no `key`.
    pub(super) fn missing(&self, key: &str, expected: &str) -> Error {
        let problem = format!("{} has no {key}, expected {expected}", self.label);
        self.source.error(self.at, problem)
    }

    fn inner(&self, schema: &Schema, value: &'a Spanned<DeValue<'a>>) -> Result<Table<'a>, Error> {
        let DeValue::Table(entries) = value.get_ref() else {
            return Err(self.not_a_list(schema, value));
        };
        let table = Table {
            source: self.source,
            label: schema.label,
            at: value.span().start,
            entries,
        };
        table.with_known_keys(schema.keys)
    }

    fn with_known_keys(self, known: &[&str]) -> Result<Table<'a>, Error> {
        let unknown = self.entries.keys().filter(|key| {
            let key: &str = key.get_ref();
            !known.contains(&key)
        });
        match unknown.min_by_key(|key| key.span().start) {
            None => Ok(self),
            Some(key) => {
                let problem = format!(
                    "unknown key {} in {}{}",
                    quoted(key.get_ref()),
                    self.label,
                    suggestion(key.get_ref(), known.iter().copied())
                );
                Err(self.source.error(key.span().start, problem))
            }
        }
    }

    fn not_a_list(&self, schema: &Schema, value: &Spanned<DeValue<'_>>) -> Error {
        let problem = format!(
            "{} is {}, expected a list of {}",
            schema.key,
            self.found(value),
            schema.label
        );
        self.source.error(value.span().start, problem)
    }

    /// A value as the file has it; tables, whose text may be anywhere, by their type.
    fn found(&self, value: &Spanned<DeValue<'_>>) -> String {
        match value.get_ref() {
            DeValue::Table(_) => "a table".into(),
            DeValue::Array(items) if items.iter().any(|item| item.get_ref().is_table()) => {
                "a list of tables".into()
            }
            _ => self.source.excerpt(value.span()),
        }
    }
}
