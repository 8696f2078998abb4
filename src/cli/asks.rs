//! What files ask for and what luch does with it, as `luch info` and a render's summary tell it.

use luch::load::{Ask, Asset, Treatment};
use serde::Serialize;

/// Something that a file asks for: the fields of `--json`.
#[derive(Serialize)]
pub(super) struct AskInfo {
    what: String,
    required: bool,
    /// Honoured, approximated or ignored.
    treatment: &'static str,
    /// What stands for it, where it is approximated.
    by: Option<&'static str>,
}

impl AskInfo {
    pub(super) fn of(ask: &Ask) -> AskInfo {
        AskInfo {
            what: ask.what.clone(),
            required: ask.required,
            treatment: ask.treatment.name(),
            by: match ask.treatment {
                Treatment::Approximated(by) => Some(by),
                Treatment::Honoured | Treatment::Ignored => None,
            },
        }
    }

    pub(super) fn in_words(&self) -> String {
        let required = if self.required { ", required" } else { "" };
        let by = self.by.map_or(String::new(), |by| format!(": {by}"));
        format!("{}{required}: {}{by}", self.what, self.treatment)
    }
}

/// What the models of a scene ask for, each once, by what luch does with it.
#[derive(Default, Serialize)]
pub(super) struct Asked {
    honoured: Vec<String>,
    approximated: Vec<String>,
    ignored: Vec<String>,
}

impl Asked {
    pub(super) fn of(asset: &Asset) -> Asked {
        let mut asked = Asked::default();
        for ask in asset
            .models
            .iter()
            .flat_map(|placed| &placed.model.facts.asks)
        {
            let list = match ask.treatment {
                Treatment::Honoured => &mut asked.honoured,
                Treatment::Approximated(_) => &mut asked.approximated,
                Treatment::Ignored => &mut asked.ignored,
            };
            if !list.contains(&ask.what) {
                list.push(ask.what.clone());
            }
        }
        asked
    }

    /// One line, as in `asked: 2 honoured; approximated: mipmaps; ignored: ACME_x`; none where nothing is asked.
    pub(super) fn in_words(&self) -> Option<String> {
        let mut parts = Vec::new();
        if !self.honoured.is_empty() {
            parts.push(format!("{} honoured", self.honoured.len()));
        }
        for (list, treatment) in [
            (&self.approximated, "approximated"),
            (&self.ignored, "ignored"),
        ] {
            if !list.is_empty() {
                parts.push(format!("{treatment}: {}", list.join(", ")));
            }
        }
        (!parts.is_empty()).then(|| format!("asked: {}", parts.join("; ")))
    }
}
