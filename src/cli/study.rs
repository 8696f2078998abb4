//! `luch study`: measures how search affects time, and leaves a folder with the report.

mod arguments;
mod folder;
mod subject;

pub(super) use arguments::StudyArguments;

use super::interrupt::Interrupt;
use super::progress::{self, Listener, State};
use super::{Failure, command_line, print};
use arguments::{Common, StudyCommand};
use folder::Folder;
use luch::accel::{Isa, Options};
use luch::shade::Shading;
use luch::study::machine::{self, Machine};
use luch::study::plan::{Effort, Plan};
use luch::study::report::Report;
use luch::study::results::{Circumstances, Measured, Results};
use luch::study::scenes::Shape;
use luch::study::{self, Watch, bvh, opening, rays, samples, scaling};
use std::sync::Arc;
use std::time::Instant;
use subject::{Subject, generated};

/// The exit code of a study in which some setting changed the picture.
const OTHER_PICTURE: u8 = 3;

/// What a study is about, and how its results become a report.
struct Task<'a> {
    plan: Plan,
    subject: Subject,
    common: &'a Common,
    report: fn(&Results) -> Report,
}

/// Does the study that the arguments ask for.
pub(super) fn run(arguments: &StudyArguments) -> Result<(), Failure> {
    let started = Instant::now();
    let common = arguments.command.common();
    let folder = Folder::open(&common.output(arguments.command.name()), common.resume)?;
    let task = match &arguments.command {
        StudyCommand::Bvh(bvh) => of_bvh(bvh),
        StudyCommand::Scaling(scaling) => of_scaling(scaling),
        StudyCommand::Samples(samples) => of_samples(samples),
        StudyCommand::Rays(rays) => of_rays(rays),
    }?;
    measure(&task, &folder, started)
}

/// The effort that the arguments ask for.
fn effort(common: &Common) -> Result<Effort, Failure> {
    let effort = match (common.quick, common.budget) {
        (true, _) => Effort::QUICK,
        (_, Some(minutes)) => Effort::within(minutes).map_err(Failure::usage_or_scene)?,
        (false, None) => Effort::DEFAULT,
    };
    let size = common.size.map(|size| [size.width, size.height]);
    Ok(Effort {
        size: size.unwrap_or(effort.size),
        ..effort
    })
}

fn of_bvh(arguments: &arguments::BvhArguments) -> Result<Task<'_>, Failure> {
    let common = &arguments.common;
    let effort = effort(common)?;
    let subject = Subject::open(
        &arguments.model,
        arguments.camera.as_deref(),
        effort.size,
        &common.reading,
    )?;
    let all = if common.quick || effort.budget <= Effort::QUICK.budget {
        bvh::Choices::quick()
    } else {
        bvh::Choices::all()
    };
    let choices = bvh::Choices {
        obvhs_presets: arguments.presets.clone().unwrap_or(all.obvhs_presets),
        presets: arguments.presets.clone().unwrap_or(all.presets),
        leaf_sizes: arguments.leaf_sizes.clone().unwrap_or(all.leaf_sizes),
        layouts: arguments.layouts.clone().unwrap_or(all.layouts),
        kernels: kernels(arguments.kernels.clone())?,
    };
    let plan = Plan {
        cases: bvh::cases(&subject.source, &choices),
        measures: bvh::MEASURES.to_vec(),
        heat_maps: vec!["preset fastest".into(), bvh::DEFAULT.into()],
        ..plan("bvh", common, effort, &subject)
    };
    Ok(Task {
        plan,
        subject,
        common,
        report: bvh::report,
    })
}

fn of_scaling(arguments: &arguments::ScalingArguments) -> Result<Task<'_>, Failure> {
    let common = &arguments.common;
    let effort = effort(common)?;
    let options = usual_options()?;
    let (subject, cases) = match &arguments.model {
        Some(model) => {
            let subject = Subject::open(
                model,
                arguments.camera.as_deref(),
                effort.size,
                &common.reading,
            )?;
            let resized = subject.resized();
            let shapes = [subject.name.clone()];
            let cases = scaling::cases(&shapes, &arguments.counts, &options, resized);
            (subject, cases)
        }
        None => {
            let shapes = arguments.shapes.as_deref().unwrap_or(&Shape::ALL);
            let names: Vec<String> = shapes.iter().map(|shape| shape.name().into()).collect();
            let cases = scaling::cases(&names, &arguments.counts, &options, |name, count| {
                generated(Shape::named(name).unwrap_or(Shape::Grid), count)
            });
            (Subject::of_shapes(shapes), cases)
        }
    };
    let plan = Plan {
        cases,
        measures: scaling::MEASURES.to_vec(),
        ..plan("scaling", common, effort, &subject)
    };
    Ok(Task {
        plan,
        subject,
        common,
        report: scaling::report,
    })
}

fn of_samples(arguments: &arguments::SamplesArguments) -> Result<Task<'_>, Failure> {
    let common = &arguments.common;
    let mut effort = effort(common)?;
    if common.size.is_none() {
        effort.size = samples::SIZE;
    }
    let subject = match &arguments.input {
        Some(input) => Subject::open(
            input,
            arguments.camera.as_deref(),
            effort.size,
            &common.reading,
        )?,
        None => Subject::figure_4(effort.size)?,
    };
    let options = usual_options()?;
    let plan = Plan {
        cases: samples::cases(&subject.source, &arguments.samples, &options),
        measures: samples::MEASURES.to_vec(),
        error_against: Some(samples::ERROR_AGAINST),
        ..plan("samples", common, effort, &subject)
    };
    Ok(Task {
        plan,
        subject,
        common,
        report: samples::report,
    })
}

fn of_rays(arguments: &arguments::RaysArguments) -> Result<Task<'_>, Failure> {
    let common = &arguments.common;
    let effort = effort(common)?;
    let subject = Subject::open(
        &arguments.model,
        arguments.camera.as_deref(),
        effort.size,
        &common.reading,
    )?;
    let plan = Plan {
        cases: rays::cases(&subject.source, &kernels(arguments.kernels.clone())?),
        measures: rays::MEASURES.to_vec(),
        ..plan("rays", common, effort, &subject)
    };
    Ok(Task {
        plan,
        subject,
        common,
        report: rays::report,
    })
}

/// The usual tree, with the kernels that `LUCH_ISA` asks for.
fn usual_options() -> Result<Options, Failure> {
    Ok(Options {
        isa: Isa::asked().map_err(Failure::usage_or_scene)?,
        ..Options::default()
    })
}

/// The kernels asked for; those of this machine, or what `LUCH_ISA` says, where none are.
fn kernels(asked: Option<Vec<Isa>>) -> Result<Vec<Isa>, Failure> {
    let of_environment = std::env::var_os(Isa::VARIABLE)
        .map(|_| Isa::asked().map(|isa| vec![isa]))
        .transpose()
        .map_err(Failure::usage_or_scene)?;
    Ok(asked.or(of_environment).unwrap_or_else(Isa::available))
}

fn plan(study: &'static str, common: &Common, effort: Effort, subject: &Subject) -> Plan {
    let cores = std::thread::available_parallelism().map_or(1, Into::into);
    Plan {
        study,
        cases: Vec::new(),
        measures: Vec::new(),
        effort,
        max_depth: subject.max_depth.unwrap_or(5),
        shading: subject.shading.unwrap_or(Shading::BlinnPhong),
        texture_filter: subject.texture_filter.unwrap_or_default(),
        threads: common.threads.map_or(cores, |threads| threads as usize),
        error_against: None,
        heat_maps: Vec::new(),
    }
}

/// Measures what is not in the folder yet, and writes everything.
fn measure(task: &Task, folder: &Folder, started: Instant) -> Result<(), Failure> {
    let Task {
        plan,
        subject,
        common,
        ..
    } = task;
    let plan = plan.clone().checked().map_err(Failure::usage_or_scene)?;
    folder.make()?;
    let before = machine::load_average();
    let others = machine::Watch::start();
    let mut results = match folder.results()? {
        Some(results) => {
            folder.must_match(&results, &plan, subject)?;
            results
        }
        None => Results::new(plan.study, circumstances(&plan, subject, before)),
    };
    let earlier = results.circumstances.seconds;
    let watch = Arc::new(Watch::default());
    Interrupt::watch_once(watch.clone());
    if !common.quiet {
        subject.lines.iter().for_each(|line| print::to_stderr(line));
    }
    let state = || State {
        doing: watch.doing(),
        share: watch.share(),
        left: Some(watch.left()),
    };
    let mut problem = None;
    let mut save = |results: &Results| {
        problem = folder.save(results).err().or(problem.take());
    };
    let listener = if common.quiet {
        Listener::Nobody
    } else {
        Listener::Person
    };
    let pictures = progress::shown(listener, &state, || {
        study::run(&plan, &mut results, &watch, started, &mut save)
    });
    let pictures = pictures.map_err(Failure::usage_or_scene)?;
    if let Some(problem) = problem {
        return Err(problem);
    }
    results.circumstances.others_share = others.others_share();
    results.circumstances.seconds = earlier + started.elapsed().as_secs_f64();
    folder.save(&results)?;
    let mut report = (task.report)(&results);
    opening::complete(&mut report, &results);
    report.pictures = pictures;
    folder.write(&results, &report)?;
    conclude(task, folder, &results, &report)
}

/// Says what was found, and where it is.
fn conclude(
    task: &Task,
    folder: &Folder,
    results: &Results,
    report: &Report,
) -> Result<(), Failure> {
    if !task.common.quiet {
        for remark in &report.warnings {
            print::to_stderr(&format!("warning: {remark}"));
        }
        let mut lines: Vec<String> = report.findings.clone();
        lines.push(format!(
            "wrote {}",
            print::path(&folder.path("report.html"))
        ));
        let text: String = lines
            .iter()
            .map(|line| print::one_line(line) + "\n")
            .collect();
        print::to_stdout(text.as_bytes())?;
    }
    let wrong = |case: &&Measured| !results.gave_the_same_picture(&case.name);
    if let Some(case) = results.cases.iter().find(wrong) {
        return Err(Failure {
            error: format!(
                "{}: another picture than the reference's; see the report",
                case.name
            )
            .into(),
            code: OTHER_PICTURE,
        });
    }
    if results.partial {
        return Err(Failure {
            error: "interrupted; what was measured is written, and --resume goes on".into(),
            code: super::interrupt::exit_code(),
        });
    }
    Ok(())
}

fn circumstances(plan: &Plan, subject: &Subject, load_before: Option<f64>) -> Circumstances {
    let machine = Machine::read();
    let kernel = plan.cases.first().map(|case| case.options.isa.name());
    Circumstances {
        command: command_line(),
        subject: subject.name.clone(),
        model_sha256: subject.sha256.clone(),
        version: machine::VERSION.into(),
        commit: machine::COMMIT.into(),
        compiler: machine::COMPILER.into(),
        cpu: machine.cpu,
        logical_cores: machine.logical_cores,
        threads: plan.threads,
        memory: machine.memory_bytes,
        system: machine.system,
        kernel: kernel.unwrap_or_default().into(),
        size: plan.effort.size,
        load_before,
        others_share: None,
        seconds: 0.0,
    }
}
