//! The tables of the paper, with its figures beside.

use super::paper_figures::{
    BY_FOUND_LABELS, BY_TRUE_LABELS, CALIBRATION, SEGMENTATION, row as printed,
};
use super::pose_errors::{PoseErrors, Statistics};
use super::scores::{BEST, Calibrated, METHODS, NOTHING, OURS, OURS_ICP, Scores, TAG, TRUE_ICP};
use super::table::{Cell, Row, Table};
use crate::segment::{ARM, BACKGROUND, END_EFFECTOR};

/// What a model made of each recording.
type OfModel<'a> = (&'a str, &'a [(String, Scores)]);

/// The tables of what each model made of each recording: labels, poses and calibrations of the first, and with several
/// models, which of them does how well where.
pub fn tables(models: &[OfModel<'_>]) -> Vec<Table> {
    let Some((_, first)) = models.first() else { return Vec::new() };
    let mut all = Scores::default();
    first.iter().for_each(|(_, scores)| all.merge(scores));
    let mut tables = vec![
        segmentation(&all),
        poses(
            "Pose of the end-effector in one frame, true labels",
            &all.by_true_labels,
            &BY_TRUE_LABELS,
        ),
        poses(
            "Pose of the end-effector in one frame, labels found",
            &all.by_found_labels,
            &BY_FOUND_LABELS,
        ),
        calibrations(&all.calibrations),
    ];
    if models.len() > 1 {
        tables.push(across(models, OURS_ICP));
        tables.push(across(models, BEST));
    }
    tables
}

fn segmentation(scores: &Scores) -> Table {
    let classes = [("end-effector", END_EFFECTOR), ("arm", ARM), ("background", BACKGROUND)];
    let mut sums = [0.0; 3];
    let mut rows: Vec<Row> = Vec::new();
    let figures = |name: &str, values: [f64; 3]| {
        let paper = printed(&SEGMENTATION, name);
        let cell = |at: usize| Cell::of(values[at]).beside(paper.map(|paper| paper[at]));
        Row { name: name.to_owned(), cells: [0, 1, 2].map(cell).to_vec() }
    };
    for (name, class) in classes {
        let score = scores.labels.class(usize::from(class));
        let values = [score.precision, score.recall, score.accuracy];
        sums.iter_mut().zip(values).for_each(|(sum, value)| *sum += value / classes.len() as f64);
        rows.push(figures(name, values));
    }
    rows.push(figures("all", sums));
    let columns = ["precision", "recall", "accuracy"].map(str::to_owned).to_vec();
    Table { title: "Segmentation by pixel (the paper's figures in brackets)".into(), columns, rows }
}

fn poses(title: &str, errors: &[PoseErrors], paper: &[(&str, [[f64; 2]; 3])]) -> Table {
    let row = |((name, ..), errors): (&(&str, _, _), &PoseErrors)| {
        let printed = printed(paper, name);
        let of = |values: &[f64], at: usize| {
            let Statistics { mean, deviation } = Statistics::of(values)?;
            let paper = printed.map(|paper| paper[at][0]);
            Some(Cell { deviation: Some(deviation), ..Cell::of(mean) }.beside(paper))
        };
        let bound = errors.within_bound as f64 / errors.told.max(1) as f64;
        let cells = vec![
            of(&errors.translation_mm, 0).unwrap_or_default(),
            of(&errors.rotation_deg, 1).unwrap_or_default(),
            of(&errors.add_mm, 2).unwrap_or_default(),
            Cell::count(errors.frames),
            Cell::count(errors.answered()),
            Cell::count(errors.wrong()),
            Cell::of((errors.told > 0).then_some(bound)),
        ];
        Row { name: (*name).to_owned(), cells }
    };
    let known = METHODS.iter().zip(errors).filter(|(_, errors)| !errors.is_empty());
    let columns = [
        "translation mm",
        "rotation deg",
        "ADD mm",
        "frames",
        "answered",
        "beyond 10 mm",
        "within 95 % bound",
    ];
    let columns = columns.map(str::to_owned).to_vec();
    Table { title: title.to_owned(), columns, rows: known.map(row).collect() }
}

fn calibrations(all: &[Calibrated]) -> Table {
    let row = |name: &&str| {
        let own: Vec<&Calibrated> = all.iter().filter(|it| it.method == *name).collect();
        let paper = printed(&CALIBRATION, name);
        let (translation, rotation) = both(&own);
        let trusted = own.iter().filter(|it| it.trusted).count();
        let cells = vec![
            translation.beside(paper.map(|paper| paper[0])),
            rotation.beside(paper.map(|paper| paper[1])),
            Cell::count(own.len()),
            Cell::count(trusted),
        ];
        Row { name: (*name).to_owned(), cells }
    };
    let there = |name: &&&str| **name != TAG || all.iter().any(|it| it.method == TAG);
    let names = [TAG, OURS, OURS_ICP, TRUE_ICP, BEST, NOTHING];
    let rows = names.iter().filter(there).map(row).collect();
    let columns = ["translation mm", "rotation deg", "recordings", "trusted"];
    let columns = columns.map(str::to_owned).to_vec();
    Table { title: "Calibration of a recording".into(), columns, rows }
}

/// Mean errors of translation and rotation.
fn both(calibrations: &[&Calibrated]) -> (Cell, Cell) {
    let off = || calibrations.iter().filter_map(|it| it.off);
    let cell = |values: Vec<f64>| match Statistics::of(&values) {
        None => Cell::default(),
        Some(Statistics { mean, deviation }) => {
            let deviation = (values.len() > 1).then_some(deviation);
            Cell { deviation, ..Cell::of(mean) }
        }
    };
    let translation = cell(off().map(|off| off.translation_mm).collect());
    (translation, cell(off().map(|off| off.rotation_deg).collect()))
}

/// How far off calibrations by `method` are, of each model on each recording.
fn across(models: &[OfModel<'_>], method: &str) -> Table {
    let recordings: Vec<&String> = models[0].1.iter().map(|(name, _)| name).collect();
    let names = recordings.into_iter().cloned().chain(["average".to_owned()]);
    let columns = names.flat_map(|name| [format!("{name} mm"), format!("{name} deg")]).collect();
    let row = |(name, recordings): &OfModel<'_>| {
        let of = |scores: &Scores| -> Vec<Calibrated> {
            scores.calibrations.iter().filter(|it| it.method == method).cloned().collect()
        };
        let each: Vec<Vec<Calibrated>> = recordings.iter().map(|(_, scores)| of(scores)).collect();
        let all: Vec<&Calibrated> = each.iter().flatten().collect();
        let of_each = each.iter().map(|own| both(&own.iter().collect::<Vec<_>>()));
        let cells = of_each.chain([both(&all)]).flat_map(|(mm, deg)| [mm, deg]);
        Row { name: (*name).to_owned(), cells: cells.collect() }
    };
    let title = format!("Calibration by each model, {method}");
    Table { title, columns, rows: models.iter().map(row).collect() }
}
