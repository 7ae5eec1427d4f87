//! What watches told at each frequency of a response.

use tsubu_frame::{Table, csv::split_unit};

use super::{abscissa, curve_names};
use crate::figure::{Axis, Figure, Series, Style};
use crate::page::Block;
use crate::source::Source;

/// What the columns beside a watched mean end in.
const LOW: &str = " spread low";
const HIGH: &str = " spread high";

/// A chart for each watched column, a curve a case; bands span the seeds.
pub(super) fn blocks(source: &mut Source, table: &Table, by_ratio: bool) -> Vec<Block> {
    let beside = |name: &str, end: &str| table.numbers(&format!("{name}{end}"));
    let columns = table.header.iter().filter_map(|header| {
        let name = split_unit(header).0;
        Some((header, name, table.numbers(name)?, beside(name, LOW)?, beside(name, HIGH)?))
    });
    let (names, x) = (curve_names(table), table.numbers(abscissa(by_ratio).1).unwrap_or_default());
    let mut blocks = Vec::new();
    for (header, name, mean, low, high) in columns {
        let mut curves: Vec<(&str, Vec<[f64; 4]>)> = Vec::new();
        for (row, curve) in names.iter().enumerate().filter(|(row, _)| mean[*row].is_finite()) {
            let point = [x[row], mean[row], low[row], high[row]];
            match curves.iter_mut().find(|(known, _)| known == curve) {
                Some((_, points)) => points.push(point),
                None => curves.push((curve, vec![point])),
            }
        }
        let mut figure = Figure::new("", abscissa(by_ratio).0, Axis::from_header(header));
        let mut spread = false;
        for (curve, mut points) in curves {
            points.sort_by(|a, b| a[0].total_cmp(&b[0]));
            let line = Series::line(curve, points.iter().map(|p| (p[0], p[1])).collect()).styled(Style::LineAndPoints);
            let banded = points.iter().any(|p| p[3] > p[2]);
            spread |= banded;
            let band = points.iter().map(|p| (p[2], p[3])).collect();
            figure = figure.with(if banded { line.with_band(band) } else { line });
        }
        let file = format!("response_{}", name.replace(|c: char| !c.is_ascii_alphanumeric(), "_"));
        let band = if spread { " The bands span the seeds." } else { "" };
        let caption = format!("{name}, in the mean over the measured periods.{band}");
        blocks.extend(source.figure(&file, &figure, &caption));
    }
    blocks
}
