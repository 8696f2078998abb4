//! What extensions say of a material, read before its textures are.

use super::document::{Document, named};
use super::extensions;
use super::materials::Reader;
use super::materials_anisotropy::{self, Anisotropy};
use super::materials_clearcoat::{self, Clearcoat};
use super::materials_diffuse_transmission::{self, DiffuseTransmission};
use super::materials_dispersion::{self, Dispersion};
use super::materials_ior::{self, Ior};
use super::materials_iridescence::{self, Iridescence};
use super::materials_sheen::{self, Sheen};
use super::materials_specular::{self, Specular};
use super::materials_specular_glossiness::{self, SpecularGlossiness};
use super::materials_transmission::{self, Beyond, Transmission};
use super::materials_volume::{self, Volume};
use super::texture_info::TextureInfo;
use crate::Error;
use crate::load::Warnings;
use crate::material::{self, Finish};
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};

/// What extensions say of one material; each may be absent.
#[derive(Default)]
pub(super) struct Extended {
    ior: Option<Ior>,
    specular: Option<Specular>,
    transmission: Option<Transmission>,
    volume: Option<Volume>,
    dispersion: Option<Dispersion>,
    clearcoat: Option<Clearcoat>,
    sheen: Option<Sheen>,
    iridescence: Option<Iridescence>,
    anisotropy: Option<Anisotropy>,
    diffuse_transmission: Option<DiffuseTransmission>,
    /// Instead of metallic-roughness and of all the others.
    pub(super) specular_glossiness: Option<SpecularGlossiness>,
}

/// What the extensions of each material of a file say. One that is not as its specification has it is left out.
pub(super) fn of_materials(document: &Document, warnings: &mut Warnings) -> Vec<Extended> {
    let materials = document.root.materials.iter().enumerate();
    materials
        .map(|(index, json)| {
            let others = json.extensions.as_ref().map(|e| &e.others);
            let place = || named("material", index, json.name.as_ref());
            others.map_or_else(Extended::default, |others| {
                Extended::read(others, place, warnings)
            })
        })
        .collect()
}

impl Extended {
    fn read(
        others: &Map<String, Value>,
        place: impl Fn() -> String,
        warnings: &mut Warnings,
    ) -> Extended {
        let mut source = Source {
            others,
            place: &place,
            warnings,
        };
        Extended {
            ior: source.one(materials_ior::NAME),
            specular: source.one(materials_specular::NAME),
            transmission: source.one(materials_transmission::NAME),
            volume: source.one(materials_volume::NAME),
            dispersion: source.one(materials_dispersion::NAME),
            clearcoat: source.one(materials_clearcoat::NAME),
            sheen: source.one(materials_sheen::NAME),
            iridescence: source.one(materials_iridescence::NAME),
            anisotropy: source.one(materials_anisotropy::NAME),
            diffuse_transmission: source.one(materials_diffuse_transmission::NAME),
            specular_glossiness: source.one(materials_specular_glossiness::NAME),
        }
    }

    /// The textures that are read, by their index in the file.
    pub(super) fn textures(&self) -> impl Iterator<Item = usize> {
        let mut infos: Vec<&Option<TextureInfo>> = Vec::new();
        infos.extend(self.specular.iter().flat_map(Specular::textures));
        infos.extend(self.transmission.iter().flat_map(Transmission::textures));
        infos.extend(self.clearcoat.iter().flat_map(Clearcoat::textures));
        infos.extend(self.sheen.iter().flat_map(Sheen::textures));
        infos.extend(self.iridescence.iter().flat_map(Iridescence::textures));
        infos.extend(self.anisotropy.iter().flat_map(Anisotropy::textures));
        let through = self.diffuse_transmission.iter();
        infos.extend(through.flat_map(DiffuseTransmission::textures));
        let glossy = self.specular_glossiness.iter();
        infos.extend(glossy.flat_map(SpecularGlossiness::textures));
        infos.into_iter().flatten().map(|info| info.index)
    }

    /// The light that goes through.
    ///
    /// # Errors
    ///
    /// A texture does not exist.
    pub(super) fn transmission(
        &self,
        reader: &mut Reader,
    ) -> Result<Option<material::Transmission>, Error> {
        let beyond = Beyond {
            ior: self.ior.as_ref(),
            volume: self.volume.as_ref(),
            dispersion: self.dispersion.as_ref(),
        };
        self.transmission
            .as_ref()
            .map_or(Ok(None), |transmission| transmission.read(beyond, reader))
    }

    /// What is added to a metallic-roughness surface; nothing where no extension does.
    ///
    /// # Errors
    ///
    /// A texture does not exist.
    pub(super) fn finish(&self, reader: &mut Reader) -> Result<Option<Box<Finish>>, Error> {
        let mut finish = Finish::PLAIN;
        if let Some(ior) = &self.ior {
            finish.ior = ior.reflecting(reader);
        }
        if let Some(specular) = &self.specular {
            (finish.specular, finish.specular_color) = specular.read(reader)?;
        }
        if let Some(clearcoat) = &self.clearcoat {
            finish.clearcoat = clearcoat.read(reader)?;
        }
        if let Some(sheen) = &self.sheen {
            finish.sheen = sheen.read(reader)?;
        }
        if let Some(iridescence) = &self.iridescence {
            finish.iridescence = iridescence.read(reader)?;
        }
        if let Some(anisotropy) = &self.anisotropy {
            finish.anisotropy = anisotropy.read(reader)?;
        }
        if let Some(through) = &self.diffuse_transmission {
            finish.diffuse_transmission = through.read(reader)?;
        }
        Ok((finish != Finish::PLAIN).then(|| Box::new(finish)))
    }
}

/// Where a material's extensions are read from.
struct Source<'a> {
    others: &'a Map<String, Value>,
    place: &'a dyn Fn() -> String,
    warnings: &'a mut Warnings,
}

impl Source<'_> {
    fn one<T: DeserializeOwned>(&mut self, name: &str) -> Option<T> {
        extensions::read(Some(self.others), name).unwrap_or_else(|problem| {
            let place = (self.place)();
            self.warnings
                .add(format!("{place}, {name}: {problem}: it is ignored"));
            None
        })
    }
}
