//! What is in a model.

use super::super::asks::AskInfo;
use super::animation::{self, Animation};
use super::{Line, listed};
use crate::cli::print::{self, counted};
use indicatif::HumanCount;
use luch::load::{Model, Note, TextureFacts};
use serde::Serialize;

/// What is in a model. Names are empty strings where the file has none.
#[derive(Serialize)]
pub(super) struct ModelInfo {
    pub(super) file: String,
    format: String,
    scenes: Vec<String>,
    nodes: usize,
    meshes: Vec<String>,
    /// Each mesh once, however often it is placed.
    triangles: usize,
    points: usize,
    lines: usize,
    materials: Vec<String>,
    /// Of the materials, for `--variant`.
    variants: Vec<String>,
    textures: Vec<Texture>,
    lights: Vec<String>,
    cameras: Vec<String>,
    animations: Vec<Animation>,
    /// What the file asks for, and what luch does with it.
    asks: Vec<AskInfo>,
    /// `extras` and metadata, with whose they are.
    notes: Vec<NoteInfo>,
}

#[derive(Serialize)]
struct Texture {
    name: String,
    /// Width and height; `None` where no material asks for it, or it could not be read.
    size: Option<(u32, u32)>,
}

/// So many notes are told in words.
const SHOWN_NOTES: usize = 8;

#[derive(Serialize)]
struct NoteInfo {
    of: String,
    says: serde_json::Value,
}

impl ModelInfo {
    pub(super) fn of(model: &Model) -> ModelInfo {
        let facts = &model.facts;
        // The last material is luch's own, for parts without one.
        let own_materials = model.materials.len().saturating_sub(1);
        let materials = model.materials.iter().take(own_materials);
        let texture = |TextureFacts { name, size }: &TextureFacts| Texture {
            name: name.clone(),
            size: *size,
        };
        ModelInfo {
            file: print::path(&model.file),
            format: facts.format.clone(),
            scenes: facts.scenes.clone(),
            nodes: model.nodes.len(),
            meshes: model.shapes.iter().map(|mesh| mesh.name.clone()).collect(),
            triangles: facts.triangles,
            points: facts.points,
            lines: facts.lines,
            materials: materials.map(|m| m.name.clone()).collect(),
            variants: facts.variants.clone(),
            textures: facts.textures.iter().map(texture).collect(),
            lights: model.lights.iter().map(|l| l.name.clone()).collect(),
            cameras: model.cameras.iter().map(|c| c.name.clone()).collect(),
            animations: facts.animations.iter().map(Animation::of).collect(),
            asks: facts.asks.iter().map(AskInfo::of).collect(),
            notes: facts.notes.iter().map(NoteInfo::of).collect(),
        }
    }

    pub(super) fn in_words(&self) -> Vec<Line> {
        let textures: Vec<String> = self.textures.iter().map(Texture::in_words).collect();
        let mut lines = vec![
            ("format", self.format.clone()),
            ("scenes", listed(&self.scenes)),
            ("nodes", self.nodes.to_string()),
            ("meshes", listed(&self.meshes)),
            ("triangles", HumanCount(self.triangles as u64).to_string()),
        ];
        if self.points + self.lines > 0 {
            let points = counted(self.points as u64, "point", "points");
            let segments = counted(self.lines as u64, "line", "lines");
            lines.push(("not drawn", format!("{points}, {segments}")));
        }
        lines.push(("materials", listed(&self.materials)));
        if !self.variants.is_empty() {
            lines.push(("variants", listed(&self.variants)));
        }
        lines.extend([
            ("textures", listed(&textures)),
            ("lights", listed(&self.lights)),
            ("cameras", listed(&self.cameras)),
        ]);
        lines.extend(animation::in_words(&self.animations));
        lines.extend(self.asks.iter().map(|ask| ("asks", ask.in_words())));
        let notes = self.notes.iter().take(SHOWN_NOTES);
        lines.extend(notes.map(|note| ("note", note.in_words())));
        if let Some(more) = self.notes.len().checked_sub(SHOWN_NOTES).filter(|&n| n > 0) {
            lines.push(("note", format!("and {more} more: --json has them")));
        }
        lines
    }
}

impl Texture {
    fn in_words(&self) -> String {
        match self.size {
            Some((width, height)) => format!("{} ({width} x {height})", self.name),
            None => format!("{} (not read)", self.name),
        }
    }
}

impl NoteInfo {
    fn of(note: &Note) -> NoteInfo {
        let says = serde_json::from_str(&note.json);
        NoteInfo {
            of: note.place.clone(),
            says: says.unwrap_or_else(|_| note.json.clone().into()),
        }
    }

    /// Its beginning: some are whole documents.
    fn in_words(&self) -> String {
        let says = self.says.to_string();
        let mut shown: String = says.chars().take(100).collect();
        if shown.len() < says.len() {
            shown.push('…');
        }
        format!("{}: {shown}", self.of)
    }
}
