//! Particle pictures in pixels: shaded spheres and flat grains of any outline, any number, no display needed.

use std::fmt::Write as _;
use std::sync::{Arc, OnceLock};

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree, fontdb};

use crate::balls::{Balls, Look, common};
use crate::canvas::Canvas;
use crate::colour;
use crate::compass;
use crate::legend::{Names, colour_bar, time_label};
use crate::plot::{AXIS, INK};
use crate::text::escape;
use crate::veil::Veil;

/// Each pixel is the mean of this many squared.
const FINE: usize = 3;

/// From this width on a picture has room for the compass in its footer [pixels].
const ROOMY: f64 = 560.0;

/// A picture in pixels.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Red, green, blue, alpha of each pixel, row by row from the top; alpha not multiplied in.
    pub rgba: Vec<u8>,
}

impl Image {
    /// An image of one colour.
    pub fn filled(width: u32, height: u32, colour: [u8; 4]) -> Self {
        let pixels = width as usize * height as usize;
        Self { width, height, rgba: colour.repeat(pixels) }
    }

    /// The image as a PNG file.
    pub fn to_png(&self) -> Vec<u8> {
        let mut out = Vec::new();
        let mut encoder = png::Encoder::new(&mut out, self.width, self.height);
        encoder.set_color(png::ColorType::Rgba);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::Balanced);
        // Writing to memory fails only on sizes that do not fit; an empty file then says so to its reader.
        let written = encoder.write_header().and_then(|mut w| w.write_image_data(&self.rgba));
        if written.is_err() {
            out.clear();
        }
        out
    }

    /// Lays a picture over this one.
    pub fn put(&mut self, over: &Self, left: u32, top: u32) {
        for y in 0..over.height.min(self.height.saturating_sub(top)) {
            for x in 0..over.width.min(self.width.saturating_sub(left)) {
                let from = 4 * (y as usize * over.width as usize + x as usize);
                let to = 4 * ((y + top) as usize * self.width as usize + (x + left) as usize);
                let alpha = f32::from(over.rgba[from + 3]) / 255.0;
                for k in 0..3 {
                    let (a, b) = (f32::from(self.rgba[to + k]), f32::from(over.rgba[from + k]));
                    self.rgba[to + k] = (a + (b - a) * alpha).round() as u8;
                }
                self.rgba[to + 3] = self.rgba[to + 3].max(over.rgba[from + 3]);
            }
        }
    }
}

/// The whole picture on white: spheres, walls, time and colour scale. The height follows from the window.
pub fn picture(balls: &Balls, look: &Look, width: u32) -> Image {
    let look = common(std::slice::from_ref(balls), look);
    let w = look.window.unwrap_or([0.0, 0.0, 1.0, 1.0]);
    let margin = 0.03 * (w[2] - w[0]).max(w[3] - w[1]);
    let (across, up) = (w[2] - w[0] + 2.0 * margin, w[3] - w[1] + 2.0 * margin);
    let width = width.max(16);
    let inner = ((f64::from(width) * up / across).round() as u32).clamp(16, 8 * width);
    // Time and colour scale side by side need room; a narrow picture has them one below the other.
    let narrow = width < 400;
    let range = look.range.unwrap_or((0.0, 1.0));
    let names = Names::of(&look.names, range, f64::from(width));
    let footer = names.as_ref().map_or(0.0, Names::height) as u32 + if narrow { 74 } else { 52 };
    let mut image = Image::filled(width, inner + footer, [255; 4]);
    image.put(&spheres(balls, &look, width, inner), 0, 0);
    let scale = f64::from(width) / across;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{}\" font-family=\"Ubuntu\" fill=\"{INK}\">",
        inner + footer
    );
    let _ = write!(svg, "<svg x=\"0\" y=\"0\" width=\"{width}\" height=\"{inner}\">");
    for surface in balls.water.iter().filter(|_| !balls.space) {
        let level = f64::from(inner) - (surface[0][1] - w[1] + margin) * scale;
        compass::draw_water(&mut svg, level, [0.0, 0.0, f64::from(width), f64::from(inner)]);
    }
    for outline in balls.outlines.iter().filter(|_| !balls.space) {
        let points: Vec<String> = outline
            .iter()
            .map(|p| {
                let x = (p[0] - w[0] + margin) * scale;
                let y = f64::from(inner) - (p[1] - w[1] + margin) * scale;
                format!("{x:.2},{y:.2}")
            })
            .collect();
        let _ = write!(
            svg,
            "<polygon points=\"{}\" fill=\"none\" stroke=\"{AXIS}\" stroke-width=\"1.6\"/>",
            points.join(" ")
        );
    }
    svg.push_str("</svg>");
    if f64::from(width) >= ROOMY {
        balls.compass.draw(&mut svg, [0.22 * f64::from(width), f64::from(inner) + 36.0]);
    }
    let _ = write!(
        svg,
        "<text x=\"10\" y=\"{}\" font-size=\"13\">{}</text>",
        inner + if narrow { 64 } else { 24 },
        escape(&time_label(balls.time, look.last.unwrap_or(balls.time)))
    );
    let middle = if narrow { f64::from(width) / 2.0 } else { f64::from(width) - 145.0 };
    if let Some(names) = names {
        names.draw(&mut svg, f64::from(inner) + if narrow { 74.0 } else { 52.0 });
    } else {
        let above = balls.range().1 > range.1;
        colour_bar(&mut svg, &balls.quantity, range, above, [middle, f64::from(inner) + 14.0], "scale");
    }
    svg.push_str("</svg>");
    if let Some(over) = from_svg(&svg, 1.0) {
        image.put(&over, 0, 0);
    }
    image
}

/// The grains alone, on nothing, filling `width` by `height` pixels with the window of the look and its margin; in space
/// with the walls, as one sees through them.
pub fn spheres(balls: &Balls, look: &Look, width: u32, height: u32) -> Image {
    let w = look.window.unwrap_or_else(|| balls.extent());
    let range = look.range.unwrap_or_else(|| balls.range());
    let (width, height) = (width.clamp(1, 8192) as usize, height.clamp(1, 8192) as usize);
    let fine = match width * height {
        4_000_000.. => 1,
        300_000.. if balls.space => FINE - 1,
        _ => FINE,
    };
    let mut canvas = Canvas::new(w, width, height, fine);
    for (i, (c, r)) in balls.centres.iter().zip(&balls.radii).enumerate() {
        if c.iter().all(|x| x.is_finite()) && r.is_finite() {
            let base = colour::at(balls.shade(i, range));
            match (balls.outline(i), balls.solids.get(i)) {
                (Some(line), _) => canvas.flat(line, *r, base),
                (None, Some(Some(solid))) => canvas.solid(c, *r, solid, base),
                (None, _) => canvas.sphere(c, *r, base),
            }
        }
    }
    let veil = balls.space.then(|| Veil::of(balls, &canvas));
    averaged(&canvas, veil.as_ref(), width, height)
}

fn averaged(canvas: &Canvas, veil: Option<&Veil>, width: usize, height: usize) -> Image {
    let fine = canvas.fine;
    let mut rgba = Vec::with_capacity(4 * width * height);
    let samples = (fine * fine) as f32;
    for y in 0..height {
        for x in 0..width {
            let (mut sum, mut cover) = ([0.0_f32; 3], 0.0_f32);
            for at in (0..fine * fine).map(|k| (y * fine + k / fine) * canvas.width + x * fine + k % fine) {
                let hit = canvas.depth[at] > f32::NEG_INFINITY;
                let (mut colour, mut alpha) =
                    if hit { (canvas.colours[at].map(f32::from), 1.0) } else { ([0.0; 3], 0.0) };
                if let Some(veil) = veil {
                    (colour, alpha) = veil.over(at, colour, alpha);
                }
                for k in 0..3 {
                    sum[k] += colour[k];
                }
                cover += alpha;
            }
            rgba.extend(sum.map(|s| if cover > 0.0 { (s / cover) as u8 } else { 0 }));
            rgba.push((255.0 * cover / samples) as u8);
        }
    }
    Image { width: width as u32, height: height as u32, rgba }
}

/// Draws an SVG in pixels, with the fonts that come along; `None` if it is no SVG.
pub fn from_svg(svg: &str, scale: f32) -> Option<Image> {
    static FONTS: OnceLock<Arc<fontdb::Database>> = OnceLock::new();
    let fonts = FONTS.get_or_init(|| {
        let mut fonts = fontdb::Database::new();
        fonts.load_font_data(epaint_default_fonts::UBUNTU_LIGHT.to_vec());
        fonts.load_font_data(epaint_default_fonts::HACK_REGULAR.to_vec());
        fonts.set_sans_serif_family("Ubuntu");
        fonts.set_serif_family("Ubuntu");
        fonts.set_monospace_family("Hack");
        Arc::new(fonts)
    });
    let options = Options { fontdb: Arc::clone(fonts), font_family: "Ubuntu".into(), ..Options::default() };
    let tree = Tree::from_str(svg, &options).ok()?;
    let size = tree.size();
    let (w, h) = ((size.width() * scale).ceil() as u32, (size.height() * scale).ceil() as u32);
    let mut pixels = Pixmap::new(w, h)?;
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixels.as_mut());
    let rgba = pixels
        .pixels()
        .iter()
        .flat_map(|p| {
            let c = p.demultiply();
            [c.red(), c.green(), c.blue(), c.alpha()]
        })
        .collect();
    Some(Image { width: w, height: h, rgba })
}
