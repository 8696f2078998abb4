//! MTL, line by line, as the file says it. A wrong line costs that line alone.

use super::map::Map;
use super::text::{Lines, Words, name, shown};
use super::values::{amount, color, illumination, index_of_refraction, share};
use crate::color::Rgb;
use crate::load::Warnings;

/// A material as its file says it.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct MtlMaterial {
    pub(super) name: String,
    /// `Kd`, zero or more.
    pub(super) diffuse: Option<Rgb>,
    /// `Ks`, zero or more.
    pub(super) specular: Option<Rgb>,
    /// `Ke`, zero or more.
    pub(super) emission: Option<Rgb>,
    /// `Ns`, zero or more.
    pub(super) shininess: Option<f32>,
    /// `d`, in 0..1: 1 is opaque.
    pub(super) dissolve: Option<f32>,
    /// `Tr`, in 0..1: 0 is opaque.
    pub(super) transparency: Option<f32>,
    /// `illum`.
    pub(super) illumination: Option<u32>,
    /// `Ni`, above zero.
    pub(super) ior: Option<f32>,
    /// `Tf`, zero or more.
    pub(super) filter: Option<Rgb>,
    /// `Pr`, in 0..1.
    pub(super) roughness: Option<f32>,
    /// `Pm`, in 0..1.
    pub(super) metal: Option<f32>,
    /// `Ps`, in 0..1: how much sheen there is.
    pub(super) sheen: Option<f32>,
    /// `Pc`, in 0..1: how much clear coat there is.
    pub(super) coat: Option<f32>,
    /// `Pcr`, in 0..1.
    pub(super) coat_roughness: Option<f32>,
    /// `aniso`, in 0..1.
    pub(super) anisotropy: Option<f32>,
    /// Whether any statement is of the PBR extension.
    pub(super) is_pbr: bool,
    /// `map_Kd`.
    pub(super) diffuse_map: Option<Map>,
    /// `map_Ks`.
    pub(super) specular_map: Option<Map>,
    /// `map_Ke`.
    pub(super) emission_map: Option<Map>,
    /// `map_Pr`.
    pub(super) roughness_map: Option<Map>,
    /// `map_Pm`.
    pub(super) metal_map: Option<Map>,
    /// `map_Ps`.
    pub(super) sheen_map: Option<Map>,
    /// `map_d`.
    pub(super) dissolve_map: Option<Map>,
    /// `map_Bump` or `bump`.
    pub(super) bump_map: Option<Map>,
    /// `norm`.
    pub(super) normal_map: Option<Map>,
    /// Parts of the format that luch lacks, each once.
    pub(super) lacks: Vec<String>,
}

/// The materials of a text; `file` is its name, for warnings.
pub(super) fn read(text: &[u8], file: &str, warnings: &mut Warnings) -> Vec<MtlMaterial> {
    let mut materials: Vec<MtlMaterial> = Vec::new();
    let mut lines = Lines::new(text, 0);
    while let Some(line) = lines.next_line() {
        let mut words = Words::of(line.text);
        let Some(keyword) = words.next() else {
            continue;
        };
        if keyword.starts_with(b"#") {
            continue;
        }
        if keyword == b"newmtl" {
            materials.push(MtlMaterial {
                name: name(words.rest()),
                ..MtlMaterial::default()
            });
            continue;
        }
        let mut bad = |problem: String| {
            let number = line.number;
            warnings.add(format!(
                "{file}: line {number}: {problem}; the line is ignored"
            ));
        };
        let mut ignored = Vec::new();
        match materials.last_mut() {
            // Without its words: the file may be no MTL at all, and none of ours to quote.
            None => warnings.add(format!(
                "{file}: a statement before the first newmtl is ignored"
            )),
            Some(material) => match material.set(keyword, words, &mut ignored) {
                Ok(true) => {}
                Ok(false) => {
                    warnings.add(format!(
                        "{file}: statement \"{}\" is not supported and ignored",
                        shown(keyword)
                    ));
                    material.lack(part_of_format(keyword).map(String::from));
                }
                Err(problem) => bad(format!("{} {problem}", shown(keyword))),
            },
        }
        for option in ignored {
            if let Some(material) = materials.last_mut() {
                material.lack(Some(format!("texture option {option}")));
            }
            warnings.add(format!(
                "{file}: texture option {option} is not supported and ignored"
            ));
        }
    }
    materials
}

/// The statements of the PBR extension (http://exocortex.com/blog/extending_wavefront_mtl_to_support_pbr), but for `Ke`
/// and `norm`, which others use as well.
const PBR: [&[u8]; 12] = [
    b"pr", b"pm", b"ps", b"pc", b"pcr", b"aniso", b"anisor", b"map_pr", b"map_pm", b"map_ps",
    b"map_pc", b"map_pcr",
];

impl MtlMaterial {
    /// Takes a statement over; whether luch knows it.
    fn set(
        &mut self,
        keyword: &[u8],
        words: Words,
        ignored: &mut Vec<String>,
    ) -> Result<bool, String> {
        // Writers do not agree on capitals: map_Bump and map_bump, map_kD.
        let keyword = keyword.to_ascii_lowercase();
        self.is_pbr |= PBR.contains(&keyword.as_slice());
        match keyword.as_slice() {
            b"kd" => self.diffuse = Some(color(words)?),
            b"ks" => self.specular = Some(color(words)?),
            b"ke" => self.emission = Some(color(words)?),
            b"ns" => self.shininess = Some(amount(words)?),
            b"d" => self.dissolve = Some(share(words)?),
            b"tr" => self.transparency = Some(share(words)?),
            b"ni" => self.ior = Some(index_of_refraction(words)?),
            b"tf" => self.filter = Some(color(words)?),
            b"pr" => self.roughness = Some(share(words)?),
            b"pm" => self.metal = Some(share(words)?),
            b"ps" => self.sheen = Some(share(words)?),
            b"pc" => self.coat = Some(share(words)?),
            b"pcr" => self.coat_roughness = Some(share(words)?),
            b"aniso" => self.anisotropy = Some(share(words)?),
            b"map_ps" => self.sheen_map = Some(Map::read(words, ignored)?),
            b"map_pr" => self.roughness_map = Some(Map::read(words, ignored)?),
            b"map_pm" => self.metal_map = Some(Map::read(words, ignored)?),
            b"illum" => self.illumination = Some(illumination(words)?),
            b"map_kd" => self.diffuse_map = Some(Map::read(words, ignored)?),
            b"map_ks" => self.specular_map = Some(Map::read(words, ignored)?),
            b"map_ke" => self.emission_map = Some(Map::read(words, ignored)?),
            b"map_d" => self.dissolve_map = Some(Map::read(words, ignored)?),
            b"map_bump" | b"bump" => self.bump_map = Some(Map::read(words, ignored)?),
            b"norm" | b"map_norm" | b"map_kn" => self.normal_map = Some(Map::read(words, ignored)?),
            // Nearly every file has them, and luch has no use for them: ambient light falls on the diffuse colour.
            b"ka" | b"map_ka" | b"sharpness" => {}
            _ => return Ok(false),
        }
        Ok(true)
    }

    fn lack(&mut self, part: Option<String>) {
        self.lacks
            .extend(part.filter(|part| !self.lacks.contains(part)));
    }
}

/// What of the format a statement is that luch does not read.
fn part_of_format(keyword: &[u8]) -> Option<&'static str> {
    Some(match keyword.to_ascii_lowercase().as_slice() {
        b"refl" | b"map_refl" => "reflection maps (refl)",
        b"disp" | b"map_disp" => "displacement maps (disp)",
        b"decal" => "decals (decal)",
        b"map_ns" => "maps of highlights' width (map_Ns)",
        b"anisor" => "rotation of anisotropy (anisor)",
        b"map_pc" | b"map_pcr" => "maps of clear coat (map_Pc)",
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

    use super::*;

    fn read_all(text: &str) -> (Vec<MtlMaterial>, Vec<String>) {
        let mut warnings = Warnings::default();
        let materials = read(text.as_bytes(), "a.mtl", &mut warnings);
        (
            materials,
            warnings.iter().map(ToString::to_string).collect(),
        )
    }

    #[test]
    fn statements_belong_to_the_material_before_them() {
        let (materials, warnings) = read_all(
            "# two\nnewmtl dark oak\n\tKd .1 .2 .3 # brown\nNs 10\nnewmtl b\nKe 2\nd .5\nTr .25\n\
             illum 3\nmap_Bump -bm 2 b.png\n",
        );
        let [oak, b] = materials.as_slice() else {
            panic!("two expected")
        };
        assert_eq!(oak.name, "dark oak");
        assert_eq!(oak.diffuse, Some(Rgb::new(0.1, 0.2, 0.3)));
        assert_eq!(oak.shininess, Some(10.0));
        assert_eq!(b.emission, Some(Rgb::grey(2.0)));
        assert_eq!((b.dissolve, b.transparency), (Some(0.5), Some(0.25)));
        assert_eq!(b.illumination, Some(3));
        assert_eq!(b.bump_map.as_ref().unwrap().bump_multiplier, 2.0);
        assert_eq!(warnings, [""; 0]);
    }

    #[test]
    fn a_wrong_line_costs_that_line() {
        let lines = [
            ("Kd 0.5 0.5", "Kd has too few numbers (2), expected r g b"),
            ("Kd 1 1 x", "Kd has \"x\", expected a finite number"),
            ("Kd nan 1 1", "Kd has \"nan\", expected a finite number"),
            (
                "Ks -1 0 0",
                "Ks is -1 0 0, expected 0 or more in every channel",
            ),
            ("Ke", "Ke has too few numbers (0), expected r g b"),
            (
                "Kd spectral a.rfl",
                "Kd is given as \"spectral a.rfl\", expected r g b",
            ),
            ("Ns -1", "Ns is -1, expected 0 or more"),
            ("d 1.5", "d is 1.5, expected a share from 0 to 1"),
            (
                "d -halo 0.5",
                "d depends on the view (-halo), expected a number",
            ),
            ("Tr", "Tr has no number, expected one"),
            ("Ni 0", "Ni is 0, expected an index of refraction, as 1.5"),
            ("Pr 2", "Pr is 2, expected a share from 0 to 1"),
            ("illum 99", "illum is \"99\", expected 0 to 10"),
            ("map_Kd", "map_Kd names no texture"),
        ];
        for (line, problem) in lines {
            let (materials, warnings) = read_all(&format!("newmtl a\n{line}\nKd 1 0 0"));
            assert_eq!(
                warnings,
                [format!("a.mtl: line 2: {problem}; the line is ignored")]
            );
            assert_eq!(materials[0].diffuse, Some(Rgb::new(1.0, 0.0, 0.0)));
        }
    }

    #[test]
    fn a_statement_before_any_material_is_told() {
        assert_eq!(
            read_all("Kd 1 1 1").1,
            ["a.mtl: a statement before the first newmtl is ignored"]
        );
    }

    #[test]
    fn each_unknown_kind_is_told_once() {
        let (_, warnings) = read_all("newmtl a\nrefl a.png\nrefl b.png\nmap_Kd -mm 0 1 a.png\n");
        assert_eq!(
            warnings,
            [
                "a.mtl: statement \"refl\" is not supported and ignored (2 times)",
                "a.mtl: texture option -mm is not supported and ignored"
            ]
        );
    }
}
