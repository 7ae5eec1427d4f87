//! Draws a [`Figure`] with kuva. Nothing outside this file knows the library.

use kuva::plot::bar::BarPlot;
use kuva::plot::legend::LegendPosition;
use kuva::plot::{BandPlot, LinePlot, ScatterPlot};
use kuva::render::annotations::ReferenceLine;
use kuva::render::layout::{Layout, TickFormat};
use kuva::render::plots::Plot;
use kuva::render::theme::Theme;

use crate::figure::{Axis, Bars, Figure, Series, Style, on_white};
use crate::quantity::prefix;
use crate::text::{short, superscript};

/// Okabe and Ito's colours, told apart by colour-blind readers too; the order puts dark ones first.
pub(crate) const PALETTE: [&str; 8] =
    ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7a5195", "#6b6b6b"];
/// Colours of the chrome. The page's dark scheme finds them by these very values.
pub(crate) const INK: &str = "#24292f";
pub(crate) const FAINT: &str = "#e3e6ea";
pub(crate) const AXIS: &str = "#6e7781";

const WIDTH: u32 = 860;
/// Points of a figure that tell their values under the mouse.
const TELLING: usize = 120;
const FONT: &str = "system-ui, -apple-system, Segoe UI, Roboto, Helvetica, Arial, sans-serif";
/// Width of a letter of a label, and what the height of a figure has beside its vertical axis [pixels].
const LETTER: f64 = 7.0;
const AROUND: f64 = 70.0;
/// More points than pixels make a file large and a figure no better.
const MOST_POINTS: usize = 2400;

impl Figure {
    /// The figure as an SVG document without a background, to stand in a page of any colour.
    pub fn to_inline_svg(&self) -> String {
        svg(self)
    }

    /// The figure as an SVG file of its own, on white.
    pub fn to_svg(&self) -> String {
        on_white(&self.to_inline_svg())
    }
}

fn svg(figure: &Figure) -> String {
    let (plots, layout) = match &figure.bars {
        Some(bars) => draw_bars(figure, bars),
        None => draw_series(figure),
    };
    let height = if figure.height == 0 { 340.0 } else { f64::from(figure.height) };
    let width = if figure.width == 0 { WIDTH } else { figure.width };
    let layout = layout
        .with_width(f64::from(width))
        .with_height(height)
        .with_theme(theme())
        .with_font_family(FONT)
        .with_title_size(16)
        .with_label_size(13)
        .with_tick_size(12)
        .with_body_size(12)
        .with_legend_position(LegendPosition::OutsideBottomColumns)
        .with_legend_box(false);
    let layout = if figure.title.is_empty() { layout } else { layout.with_title(&figure.title) };
    // A label longer than its axis would be cut off at both ends: it stands above the drawing instead.
    let label = layout.y_label.clone().unwrap_or_default();
    let layout = if figure.title.is_empty() && LETTER * label.chars().count() as f64 > height - AROUND {
        layout.with_title(label).with_y_label("").with_title_size(13)
    } else {
        layout
    };
    let drawn = tidied(&kuva::render_to_svg(plots, layout));
    if width == WIDTH {
        drawn
    } else {
        drawn.replacen("<svg ", &format!("<svg style=\"max-width:{width}px;min-width:0\" "), 1)
    }
}

/// Lets the drawing scale with the page, and gives its clip path an id made from the drawing itself: kuva counts ids
/// through the process, so the same figure would differ from one report to the next.
fn tidied(svg: &str) -> String {
    let Some((head, body)) = svg.split_once('>') else { return svg.to_owned() };
    let size = |key: &str| {
        let after = head.split_once(&format!(" {key}=\""))?.1;
        after.split_once('"')?.0.parse::<f64>().ok()
    };
    // kuva keeps no room for the later rows of a long legend.
    let lowest = body.split("<text ").skip(1).filter_map(|t| t.split_once(" y=\"")?.1.split('"').next()?.parse().ok());
    let (head, view) = match (size("width"), size("height")) {
        (Some(w), Some(h)) => {
            let high = lowest.map(|y: f64| y + 10.0).fold(h, f64::max).ceil();
            let head = head.replacen(&format!(" height=\"{h}\""), &format!(" height=\"{high}\""), 1);
            (head, format!(" viewBox=\"0 0 {w} {high}\""))
        }
        _ => (head.to_owned(), String::new()),
    };
    let counted = body.split_once("id=\"kuva-clip-").and_then(|(_, b)| b.split_once('"')).map(|(n, _)| n);
    let body = match counted {
        Some(n) => {
            let plain = body.replace(&format!("kuva-clip-{n}"), "clip");
            // FNV-1a: any hash does, this one is two lines.
            let hash =
                plain.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |h, b| (h ^ u64::from(b)).wrapping_mul(0x0100_0000_01b3));
            body.replace(&format!("kuva-clip-{n}"), &format!("clip-{hash:016x}"))
        }
        None => body.to_owned(),
    };
    format!("{head}{view}>{body}")
}

fn theme() -> Theme {
    Theme {
        background: "none".into(),
        axis_color: AXIS.into(),
        grid_color: FAINT.into(),
        tick_color: AXIS.into(),
        text_color: INK.into(),
        legend_bg: "none".into(),
        legend_border: "none".into(),
        ..Theme::light()
    }
}

fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.filter(|v| v.is_finite()).fold(0.0, |a, v| a.max(v.abs()))
}

/// Factor and unit with which an axis carries short numbers: a prefix where the unit takes one, else a power of ten.
fn scale(axis: &Axis, largest: f64) -> (f64, String) {
    let (factor, unit) = prefix(&axis.unit, largest);
    let plain = (0.05..1e5).contains(&largest) || largest == 0.0 || !largest.is_finite();
    if factor != 1.0 || axis.log || plain {
        return (factor, unit);
    }
    let power = 3 * (largest.log10() / 3.0).floor() as i32;
    let unit = if unit == "-" { String::new() } else { format!(" {unit}") };
    (10f64.powi(-power), format!("10{}{unit}", superscript(&power.to_string())))
}

fn axis_label(axis: &Axis, unit: &str) -> String {
    if unit == "-" || unit.is_empty() { axis.label.clone() } else { format!("{} [{unit}]", axis.label) }
}

fn draw_series(figure: &Figure) -> (Vec<Plot>, Layout) {
    let points = || figure.series.iter().flat_map(|s| s.points.iter());
    let bands = figure.series.iter().filter_map(|s| s.band.as_ref()).flatten();
    let (fx, x_unit) = scale(&figure.x, largest(points().map(|p| p.0)));
    let tallest = largest(points().map(|p| p.1).chain(bands.map(|b| b.1)));
    let (fy, y_unit) = scale(&figure.y, tallest);
    let keep =
        |x: f64, y: f64| x.is_finite() && y.is_finite() && (!figure.x.log || x > 0.0) && (!figure.y.log || y > 0.0);
    let (mut plots, mut telling) = (Vec::new(), Vec::new());
    for (i, series) in figure.series.iter().enumerate() {
        let colour = PALETTE[series.colour.unwrap_or(i) % PALETTE.len()];
        if let Some(band) = &series.band {
            let rows: Vec<_> = series
                .points
                .iter()
                .zip(band)
                .filter(|((x, _), (low, high))| keep(*x, *low) && high.is_finite())
                .map(|((x, _), (low, high))| (x * fx, low * fy, high * fy))
                .collect();
            if !rows.is_empty() {
                let band = BandPlot::new(rows.iter().map(|r| r.0), rows.iter().map(|r| r.1), rows.iter().map(|r| r.2));
                plots.push(Plot::Band(band.with_color(colour).with_opacity(0.18)));
            }
        }
        let kept: Vec<_> = series.points.iter().filter(|(x, y)| keep(*x, *y)).map(|(x, y)| (x * fx, y * fy)).collect();
        if !kept.is_empty() {
            draw_one(series, &thinned(&kept), colour, &mut plots);
            let tells = |x: f64, y: f64| {
                let name = if series.name.is_empty() { String::new() } else { format!("{}\n", series.name) };
                let value = |axis: &Axis, unit: &str, x: f64| {
                    format!("{} {} {}", axis.label, short(x), if unit == "-" { "" } else { unit }).trim_end().to_owned()
                };
                format!("{name}{}\n{}", value(&figure.x, &x_unit, x), value(&figure.y, &y_unit, y))
            };
            telling.push(told(&kept, TELLING / figure.series.len().max(1), tells));
        }
    }
    plots.extend(telling);
    let mut layout = Layout::auto_from_plots(&plots)
        .with_x_label(axis_label(&figure.x, &x_unit))
        .with_y_label(axis_label(&figure.y, &y_unit));
    if figure.x.log {
        layout = layout.with_log_x();
    }
    if figure.y.log {
        layout = layout.with_log_y();
    }
    // A curve should fill the width, where kuva rounds the ends outwards; a hair more lets the last tick show.
    let ends = |(l, h): (f64, f64), x: f64| (l.min(x), h.max(x));
    let finite = points().map(|p| p.0 * fx).filter(|x| x.is_finite());
    let (low, high) = finite.fold((f64::INFINITY, f64::NEG_INFINITY), ends);
    if !figure.x.log && high > low {
        layout = layout.with_x_axis_min(low).with_x_axis_max(high + 0.003 * (high - low));
    }
    // A curve that comes near to nothing is seen against nothing.
    let heights = || points().map(|p| p.1 * fy).filter(|y| y.is_finite());
    let (least, most) = heights().fold((f64::INFINITY, f64::NEG_INFINITY), ends);
    if !figure.y.log && least >= 0.0 && least < 0.5 * most {
        layout = layout.with_y_axis_min(0.0);
    }
    for mark in &figure.marks {
        let line = if mark.horizontal {
            ReferenceLine::horizontal(mark.at * fy)
        } else {
            ReferenceLine::vertical(mark.at * fx)
        };
        let colour = mark.colour.map_or(AXIS, |i| PALETTE[i % PALETTE.len()]);
        let line = line.with_color(colour).with_dasharray("5 4");
        layout = layout.with_reference_line(if mark.label.is_empty() { line } else { line.with_label(&mark.label) });
    }
    (plots, layout)
}

/// Some of the points once more, unseen, with their values for the mouse.
fn told(points: &[(f64, f64)], most: usize, tells: impl Fn(f64, f64) -> String) -> Plot {
    let each = points.len().div_ceil(most.max(2));
    let some: Vec<(f64, f64)> = points.iter().copied().step_by(each).collect();
    let texts: Vec<String> = some.iter().map(|(x, y)| tells(*x, *y)).collect();
    Plot::Scatter(
        ScatterPlot::new().with_data(some).with_color("transparent").with_size(7.0).with_tooltip_labels(texts),
    )
}

fn draw_one(series: &Series, points: &[(f64, f64)], colour: &str, plots: &mut Vec<Plot>) {
    let mut named = !series.name.is_empty();
    if series.style != Style::Points {
        let mut line = LinePlot::new().with_data(points.iter().copied()).with_color(colour).with_stroke_width(1.8);
        if series.style == Style::Dashed {
            line = line.with_dashed();
        }
        if named {
            line = line.with_legend(&series.name);
            named = false;
        }
        plots.push(Plot::Line(line));
    }
    if matches!(series.style, Style::Points | Style::LineAndPoints) {
        let mut dots = ScatterPlot::new().with_data(points.iter().copied()).with_color(colour).with_size(2.8);
        if named {
            dots = dots.with_legend(&series.name);
        }
        plots.push(Plot::Scatter(dots));
    }
}

/// Keeps the lowest and the highest point of every stretch, so that no peak is lost.
fn thinned(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    if points.len() <= MOST_POINTS {
        return points.to_vec();
    }
    let stretch = points.len().div_ceil(MOST_POINTS / 2);
    let mut kept = Vec::with_capacity(MOST_POINTS);
    for part in points.chunks(stretch) {
        let by_height = |a: &&(f64, f64), b: &&(f64, f64)| a.1.total_cmp(&b.1);
        let ends = (part.iter().min_by(by_height), part.iter().max_by(by_height));
        if let (Some(&low), Some(&high)) = ends {
            let (first, second) = if low.0 <= high.0 { (low, high) } else { (high, low) };
            kept.push(first);
            if second != first {
                kept.push(second);
            }
        }
    }
    kept
}

fn draw_bars(figure: &Figure, bars: &Bars) -> (Vec<Plot>, Layout) {
    let all = bars.parts.iter().flat_map(|(_, v)| v.iter().copied());
    let (factor, unit) = scale(&figure.y, largest(all));
    let mut plot = BarPlot::new().with_width(0.7).with_horizontal(bars.horizontal);
    let order: Vec<usize> = if bars.horizontal {
        // kuva counts from the bottom; a reader from the top.
        (0..bars.categories.len()).rev().collect()
    } else {
        (0..bars.categories.len()).collect()
    };
    let mut told = Vec::new();
    for i in order {
        let category = &bars.categories[i];
        let value = |values: &[f64]| values.get(i).copied().filter(|v| v.is_finite()).unwrap_or(0.0);
        let group = bars.parts.iter().zip(PALETTE.iter().cycle()).map(|((_, v), c)| (value(v) * factor, *c));
        plot = plot.with_group(category.as_str(), group);
        told.extend(bars.parts.iter().map(|(part, v)| {
            let part = if bars.parts.len() > 1 { format!(", {part}") } else { String::new() };
            let unit = if unit == "-" { "" } else { unit.as_str() };
            format!("{category}{part}: {} {unit}", short(value(v) * factor)).trim_end().to_owned()
        }));
    }
    if bars.parts.len() > 1 {
        plot = plot.with_legend(bars.parts.iter().map(|(name, _)| name.as_str()).collect());
    }
    if bars.stacked {
        plot = plot.with_stacked();
    }
    // Labels alone would open groups in the drawing that kuva never closes.
    let plots = vec![Plot::Bar(plot.with_tooltips().with_tooltip_labels(told))];
    let label = axis_label(&figure.y, &unit);
    let layout = Layout::auto_from_plots(&plots).with_tick_format(TickFormat::Auto);
    let layout = if bars.horizontal { layout.with_x_label(label) } else { layout.with_y_label(label) };
    (plots, layout)
}

#[cfg(test)]
mod tests {
    use crate::figure::{Axis, Bars, Figure};

    /// Groups of labelled bars were opened and never closed where bars stood upright: no browser took the file.
    #[test]
    fn bars_are_whole_drawings() {
        for (stacked, horizontal) in [(false, false), (false, true), (true, false), (true, true)] {
            let parts = vec![("sliding".to_owned(), vec![1.0, 2.0]), ("drag".to_owned(), vec![0.5, 0.0])];
            let categories = vec!["0 balls".to_owned(), "20 balls".to_owned()];
            let figure = Figure::of_bars("", Axis::new("loss", "J"), Bars { categories, parts, stacked, horizontal });
            let svg = figure.to_svg();
            assert!(resvg::usvg::roxmltree::Document::parse(&svg).is_ok(), "{stacked} {horizontal}: {svg}");
        }
    }
}
