//! A whole study of a model small enough to be worked out by hand.

use crate::common::scenes;
use glam::Vec3;
use luch::accel::Isa;
use luch::camera::Camera;
use luch::generate;
use luch::mesh::Mesh;
use luch::scene::Scene;
use luch::shade::Shading;
use luch::study::bvh::{self, Choices};
use luch::study::plan::{Effort, Plan};
use luch::study::results::{Circumstances, Measured, Results, Run};
use luch::study::sets::Kind;
use luch::study::{Source, Watch, run};
use luch::texture::TextureFilter;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Twelve heaps of eight triangles, the greatest leaf, and one of four, far apart along the x axis, across which they all
/// stand: each fills half of its box, where `y + z <= 1`. The one camera ray goes along the axis through every box and past
/// every triangle.
fn heaps() -> Arc<Scene> {
    let place = |i: u32| (i / 8 * 1000) as f32 + (i % 8) as f32 * 0.01;
    let mut mesh = Mesh::default();
    for i in 0..100 {
        let corners = [Vec3::ZERO, Vec3::Y, Vec3::Z].map(|p| p + Vec3::X * place(i));
        mesh.positions.extend(corners);
        mesh.triangles.push([3 * i, 3 * i + 1, 3 * i + 2]);
    }
    let (from, to) = (Vec3::new(-1.0, 0.9, 0.9), Vec3::new(1.0, 0.9, 0.9));
    let camera = Camera::looking_at(from, to, Vec3::Y, 1e-6);
    Arc::new(Scene::new(generate::mesh_scene(mesh, camera)).expect("a scene"))
}

fn plan(scene: Arc<Scene>) -> Plan {
    let choices = Choices {
        kernels: vec![Isa::scalar()],
        ..Choices::all()
    };
    Plan {
        study: "bvh",
        cases: bvh::cases(&Source::of("heaps", scene), &choices),
        measures: bvh::MEASURES.to_vec(),
        effort: Effort {
            // Time plays no part in what is expected here: all the time in the world, and two rounds.
            budget: Duration::from_secs(100_000),
            most_rounds: 2,
            size: [1, 1],
        },
        max_depth: 0,
        shading: Shading::BlinnPhong,
        texture_filter: TextureFilter::Footprint,
        threads: 1,
        error_against: None,
        heat_maps: vec![bvh::DEFAULT.into()],
    }
}

fn studied(plan: &Plan, results: &mut Results) {
    let watch = Watch::default();
    run(plan, results, &watch, Instant::now(), &mut |_| ()).expect("threads");
}

fn nothing() -> Results {
    Results::new("bvh", Circumstances::default())
}

/// Nodes and primitives that the one camera ray is tested against.
fn primary(case: &Measured) -> (f64, f64) {
    let tests = &case.facts.as_ref().expect("facts").tests;
    let primary = tests.iter().find(|tests| tests.kind == Kind::Primary);
    let primary = primary.expect("primary rays");
    assert_eq!(primary.rays, 1);
    (primary.nodes, primary.primitives)
}

#[test]
fn a_study_of_a_hundred_triangles_gives_the_counts_worked_out_by_hand() {
    let mut results = nothing();
    studied(&plan(heaps()), &mut results);
    let case = |name| results.case(name).expect(name);
    let facts = |name| case(name).facts.clone().expect(name);

    // Thirteen leaves: a root of seven leaves and a node for the six others is all it takes.
    let default = facts(bvh::DEFAULT);
    assert_eq!((default.nodes, default.leaves, default.depth), (2, 13, 2));
    assert_eq!(default.leaf_sizes, [0, 0, 0, 1, 0, 0, 0, 12]);
    assert_eq!(primary(case(bvh::DEFAULT)), (2.0, 100.0));
    // A leaf for each triangle; all are tested whatever the nodes.
    assert_eq!(facts("leaf size 1").leaf_sizes, [100]);
    assert_eq!(primary(case("leaf size 1")).1, 100.0);
    // A binary tree has one inner node less than it has leaves.
    assert_eq!(primary(case("layout bvh2")), (12.0, 100.0));
    assert_eq!(primary(case(bvh::NO_TREE)), (0.0, 100.0));
}

#[test]
fn every_case_is_run_in_every_round_and_gives_the_reference_picture() {
    let plan = plan(heaps());
    let mut results = nothing();
    studied(&plan, &mut results);
    assert!(!results.partial);
    let builds = results
        .runs
        .iter()
        .filter(|run| run.measure == bvh::MEASURES[1]);
    assert_eq!(builds.count(), plan.cases.len() * 2);
    for case in &plan.cases {
        assert!(results.gave_the_same_picture(&case.name), "{}", case.name);
    }
    let report = bvh::report(&results);
    assert!(
        report.findings[0]
            .starts_with("For this model, at 1280 x 720 with 4 samples a pixel: for one")
    );
    assert!(
        report
            .plots
            .iter()
            .any(|plot| plot.name == "build-time-and-render-time")
    );
}

#[test]
fn a_study_that_goes_on_repeats_no_run() {
    let plan = plan(heaps());
    let mut whole = nothing();
    studied(&plan, &mut whole);
    let mut resumed = whole.clone();
    // What an interrupt before the last case of the first round leaves.
    let last = plan.cases.last().expect("cases").name.as_str();
    resumed
        .runs
        .retain(|run| run.round == 1 && run.case != last);
    resumed.partial = true;
    let before = resumed.runs.clone();
    studied(&plan, &mut resumed);
    assert_eq!(resumed.runs[..before.len()], before);
    let builds = |results: &Results| {
        let of = |run: &&Run| run.measure == bvh::MEASURES[1];
        let builds = results.runs.iter().filter(of);
        let mut names: Vec<String> = builds
            .map(|run| format!("{} {}", run.round, run.case))
            .collect();
        names.sort();
        names
    };
    assert_eq!(builds(&resumed), builds(&whole));
}

#[test]
fn a_study_that_is_cancelled_says_that_it_is_partial() {
    let watch = Watch::default();
    watch.cancel();
    let mut results = nothing();
    let plan = plan(Arc::new(
        scenes::soup_scene(vec![[Vec3::ZERO, Vec3::X, Vec3::Y]]).expect("a scene"),
    ));
    run(&plan, &mut results, &watch, Instant::now(), &mut |_| ()).expect("threads");
    assert!(results.partial && results.runs.is_empty());
}
