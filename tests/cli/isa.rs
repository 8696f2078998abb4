//! `LUCH_ISA`: the kernels that search.

use super::{EXR, Folder, Ran};
use luch::accel::Isa;

fn render(folder: &Folder, isa: Option<&str>, to: &str) -> Ran {
    let mut command = folder.command(&["render", "-q", "-o", to, "scene.toml"]);
    match isa {
        Some(isa) => command.env(Isa::VARIABLE, isa),
        None => command.env_remove(Isa::VARIABLE),
    };
    let output = command.output().expect("the program runs");
    Ran {
        code: output.status.code(),
        out: output.stdout,
        err: String::from_utf8(output.stderr).expect("UTF-8"),
    }
}

#[test]
fn every_instruction_set_gives_the_same_file() {
    let folder = Folder::with_scene_and_model();
    let ran = render(&folder, None, "picture.exr");
    assert_eq!(ran.code, Some(0), "{}", ran.err);
    let expected = folder.read("picture.exr");
    assert!(expected.starts_with(EXR));
    for isa in Isa::available() {
        let ran = render(&folder, Some(isa.name()), "picture.exr");
        assert_eq!(ran.code, Some(0), "{isa}: {}", ran.err);
        assert!(folder.read("picture.exr") == expected, "{isa}");
    }
}

#[test]
fn a_wrong_instruction_set_is_one_line_that_names_the_others() {
    let folder = Folder::with_scene_and_model();
    for (name, shown) in [("sse9", "\"sse9\""), ("", "\"\""), ("AVX2", "\"AVX2\"")] {
        let ran = render(&folder, Some(name), "none.exr");
        let line = format!(
            "error: LUCH_ISA: no instruction set is called {shown}; set it to scalar, avx2 or avx512\n"
        );
        assert_eq!((ran.code, ran.err), (Some(1), line));
    }
    assert_eq!(folder.names(), ["model.obj", "scene.toml"]);
}
