//! Particle pictures as SVG: one, or several side by side.

use std::fmt::Write as _;

use crate::balls::{Balls, Look, common};
use crate::colour;
use crate::compass;
use crate::legend::{colour_bar, time_label};
use crate::plot::{AXIS, FAINT, INK};
use crate::quantity::prefix;
use crate::raster;
use crate::text::{escape, short};

/// Above this many grains a picture is drawn in pixels inside the SVG: shapes would make it too heavy to open.
const MOST_SHAPES: usize = 1500;
const GAP: f64 = 12.0;
const WIDTH: f64 = 1000.0;
/// Below this width not all that a legend says stands in a row.
const NARROW: f64 = 700.0;

/// One picture of a strip.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Panel {
    /// What is seen.
    pub balls: Balls,
    /// Text below it, such as the phase.
    pub label: String,
    /// Direction in which the box moves, in the picture plane; its length counts against the longest of the strip.
    pub arrow: Option<[f64; 2]>,
}

/// Pictures side by side in one window and one colour scale, `columns` in a row, with a colour bar below.
pub fn strip(panels: &[Panel], look: &Look, columns: usize) -> String {
    let all: Vec<Balls> = panels.iter().map(|p| p.balls.clone()).collect();
    let look = common(&all, look);
    let window = look.window.unwrap_or([0.0, 0.0, 1.0, 1.0]);
    let range = look.range.unwrap_or((0.0, 1.0));
    let columns = columns.clamp(1, panels.len().max(1));
    let rows = panels.len().div_ceil(columns);
    let cell = ((WIDTH + GAP) / columns as f64 - GAP).min(420.0);
    let margin = 0.03 * (window[2] - window[0]).max(window[3] - window[1]);
    let (w, h) = (window[2] - window[0] + 2.0 * margin, window[3] - window[1] + 2.0 * margin);
    let scale = cell / w;
    let (picture, label) = (h * scale, 40.0);
    let width = columns as f64 * (cell + GAP) - GAP;
    // Narrow strips have the scale of lengths and the compass below the scale of colours.
    let bar = if width < NARROW { 92.0 } else { 52.0 };
    let height = rows as f64 * (picture + label) + bar;
    let longest = panels.iter().filter_map(|p| p.arrow).map(|a| a[0].hypot(a[1])).fold(0.0, f64::max);
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" \
         viewBox=\"0 0 {width:.1} {height:.1}\" font-family=\"system-ui, -apple-system, Segoe UI, Roboto, Helvetica, \
         Arial, sans-serif\" fill=\"{INK}\">"
    );
    for (i, panel) in panels.iter().enumerate() {
        let x = (i % columns) as f64 * (cell + GAP);
        let y = (i / columns) as f64 * (picture + label);
        let place = Place { x: x - (window[0] - margin) * scale, y: y + picture + (window[1] - margin) * scale, scale };
        // A window leaves out what is far off; that must not be drawn over the neighbours. The ground is white in any page:
        // slow grains are dark.
        let frame = format!("\"{x:.1}\" y=\"{y:.1}\" width=\"{cell:.1}\" height=\"{picture:.1}\"");
        let _ = write!(
            out,
            "<svg x={frame} viewBox=\"{x:.1} {y:.1} {cell:.1} {picture:.1}\"><rect x={frame} fill=\"#fff\"/>"
        );
        draw(&mut out, &panel.balls, &look, range, &place, [x, y, cell, picture]);
        out.push_str("</svg>");
        let middle = x + cell / 2.0;
        let _ = write!(
            out,
            "<text x=\"{middle:.1}\" y=\"{:.1}\" font-size=\"13\" text-anchor=\"middle\">{}</text>",
            y + picture + 16.0,
            escape(&panel.label)
        );
        if let Some(a) = panel.arrow.filter(|_| longest > 0.0) {
            // Beside the label if it goes up and down, below it otherwise.
            let upright = a[1].abs() > a[0].abs();
            let reach = if upright { 32.0 } else { 0.38 * cell } / longest;
            let at = if upright { [middle + 34.0, y + picture + 19.0] } else { [middle, y + picture + 28.0] };
            arrow(&mut out, at, [a[0] * reach, -a[1] * reach]);
        }
    }
    if let Some(first) = panels.first() {
        let gradient = format!("scale-{}-{}", panels.len(), (range.1.to_bits() ^ window[2].to_bits()) % 1_000_003);
        let above = all.iter().any(|balls| balls.range().1 > range.1);
        colour_bar(&mut out, &first.balls.quantity, range, above, [width / 2.0, height - bar + 16.0], &gradient);
        first.balls.compass.draw(&mut out, [width - compass::WIDE, height - 16.0]);
    }
    scale_bar(&mut out, cell, scale, height - 22.0);
    out.push_str("</svg>");
    out
}

/// A bar of a round length, about a quarter of a picture wide, at the left below the pictures.
fn scale_bar(out: &mut String, cell: f64, scale: f64, y: f64) {
    let longest = 0.3 * cell / scale;
    let power = 10f64.powf(longest.log10().floor());
    let Some(length) = [5.0, 2.0, 1.0].map(|digit| digit * power).into_iter().find(|length| *length <= longest) else {
        return;
    };
    let (factor, unit) = prefix("m", length);
    let (end, low, high) = (length * scale, y - 4.0, y + 4.0);
    let _ = write!(
        out,
        "<polyline points=\"1,{low:.1} 1,{high:.1} 1,{y:.1} {end:.1},{y:.1} {end:.1},{high:.1} {end:.1},{low:.1}\" stroke=\"{INK}\" \
         stroke-width=\"1.5\" fill=\"none\"/><text x=\"{:.1}\" y=\"{:.1}\" font-size=\"12\">{} {unit}</text>",
        end + 8.0,
        y + 4.0,
        short(length * factor)
    );
}

/// One picture.
pub fn picture(balls: &Balls, look: &Look) -> String {
    let label = time_label(balls.time, balls.time);
    strip(&[Panel { balls: balls.clone(), label, arrow: None }], look, 1)
}

struct Place {
    x: f64,
    y: f64,
    scale: f64,
}

impl Place {
    fn of(&self, p: &[f64; 3]) -> (f64, f64) {
        (self.x + p[0] * self.scale, self.y - p[1] * self.scale)
    }
}

fn draw(out: &mut String, balls: &Balls, look: &Look, range: (f64, f64), place: &Place, frame: [f64; 4]) {
    let [x, y, w, h] = frame;
    for surface in balls.water.iter().filter(|_| !balls.space) {
        compass::draw_water(out, place.of(&surface[0]).1, frame);
    }
    for outline in balls.outlines.iter().filter(|_| !balls.space) {
        let points: String = outline.iter().map(|p| place.of(p)).fold(String::new(), |mut s, (u, v)| {
            let _ = write!(s, "{u:.2},{v:.2} ");
            s
        });
        let _ = write!(
            out,
            "<polygon points=\"{}\" fill=\"none\" stroke=\"{AXIS}\" stroke-width=\"1.6\" stroke-linejoin=\"round\"/>",
            points.trim_end()
        );
    }
    if balls.outlines.is_empty() && !balls.space {
        let _ = write!(
            out,
            "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{w:.1}\" height=\"{h:.1}\" fill=\"none\" stroke=\"{FAINT}\"/>"
        );
    }
    if balls.space || !balls.solids.is_empty() || balls.centres.len() > MOST_SHAPES {
        let look = Look { range: Some(range), ..look.clone() };
        let png = raster::spheres(balls, &look, (2.0 * w) as u32, (2.0 * h) as u32).to_png();
        let data = crate::page::base64(&png);
        let _ = write!(
            out,
            "<image x=\"{x:.1}\" y=\"{y:.1}\" width=\"{w:.1}\" height=\"{h:.1}\" href=\"data:image/png;base64,{data}\"/>"
        );
        return;
    }
    let mut order: Vec<usize> = (0..balls.centres.len()).collect();
    order.sort_by(|&a, &b| balls.centres[a][2].total_cmp(&balls.centres[b][2]));
    let fastest = balls.velocities.iter().map(|v| v[0].hypot(v[1])).fold(0.0, f64::max);
    for i in order {
        let centre = &balls.centres[i];
        if !centre.iter().all(|c| c.is_finite()) {
            continue;
        }
        let (u, v) = place.of(centre);
        let r = balls.radii[i] * place.scale;
        let fill = colour::hex(balls.shade(i, range));
        if let Some(corners) = balls.outline(i) {
            out.push_str("<path d=\"");
            for (number, corner) in corners.enumerate() {
                let (u, v) = place.of(&corner);
                let _ = write!(out, "{}{u:.2} {v:.2}", if number == 0 { 'M' } else { 'L' });
            }
            out.push_str("Z\" fill-rule=\"evenodd\"");
        } else {
            let _ = write!(out, "<circle cx=\"{u:.2}\" cy=\"{v:.2}\" r=\"{r:.2}\"");
        }
        let edge = (0.08 * r).clamp(0.2, 1.0);
        let _ = write!(out, " fill=\"{fill}\" stroke=\"#000\" stroke-opacity=\".35\" stroke-width=\"{edge:.2}\"/>");
        if let Some(velocity) = balls.velocities.get(i).filter(|_| look.arrows && fastest > 0.0) {
            let reach = 3.0 * r / fastest;
            arrow_on_grain(
                out,
                [u + 0.5 * velocity[0] * reach, v - 0.5 * velocity[1] * reach],
                [velocity[0] * reach, -velocity[1] * reach],
            );
        }
    }
}

/// An arrow on a light ground, to be seen on dark grains too.
fn arrow_on_grain(out: &mut String, middle: [f64; 2], along: [f64; 2]) {
    if along[0].hypot(along[1]) >= 2.0 {
        let (dx, dy) = (along[0] / 2.0, along[1] / 2.0);
        let _ = write!(
            out,
            "<line x1=\"{:.1}\" y1=\"{:.1}\" x2=\"{:.1}\" y2=\"{:.1}\" stroke=\"#fff\" stroke-opacity=\".75\" \
             stroke-width=\"4\" stroke-linecap=\"round\"/>",
            middle[0] - dx,
            middle[1] - dy,
            middle[0] + dx,
            middle[1] + dy
        );
        arrow(out, middle, along);
    }
}

/// An arrow about its middle, in pixels.
fn arrow(out: &mut String, middle: [f64; 2], along: [f64; 2]) {
    let length = along[0].hypot(along[1]);
    if length < 2.0 {
        let _ = write!(out, "<circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"1.6\" fill=\"{INK}\"/>", middle[0], middle[1]);
        return;
    }
    let (ux, uy) = (along[0] / length, along[1] / length);
    let tip = [middle[0] + along[0] / 2.0, middle[1] + along[1] / 2.0];
    let tail = [middle[0] - along[0] / 2.0, middle[1] - along[1] / 2.0];
    let head = length.min(6.0);
    let neck = [tip[0] - ux * head, tip[1] - uy * head];
    let _ = write!(
        out,
        "<line x1=\"{:.1}\" y1=\"{:.1}\" x2=\"{:.1}\" y2=\"{:.1}\" stroke=\"{INK}\" stroke-width=\"1.4\"/>\
         <polygon points=\"{:.1},{:.1} {:.1},{:.1} {:.1},{:.1}\" fill=\"{INK}\"/>",
        tail[0],
        tail[1],
        neck[0],
        neck[1],
        tip[0],
        tip[1],
        neck[0] - uy * head * 0.5,
        neck[1] + ux * head * 0.5,
        neck[0] + uy * head * 0.5,
        neck[1] - ux * head * 0.5,
    );
}
