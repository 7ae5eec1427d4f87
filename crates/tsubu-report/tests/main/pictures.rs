//! Figures and particle pictures: drawable, honest about missing values, the right colour at the right place.

use tsubu_frame::Kind;
use tsubu_report::animation::{apng, gif};
use tsubu_report::balls::{Balls, ColourBy, Look, View, common};
use tsubu_report::figure::{Axis, Bars, Figure, Mark, Series, Style};
use tsubu_report::quantity::prefix;
use tsubu_report::raster::{Image, from_svg, picture, spheres};
use tsubu_report::strip::{Panel, strip};
use tsubu_report::text::{count, duration, escape, short};

use crate::fixture;

fn drawable(svg: &str) -> Image {
    from_svg(svg, 1.0).unwrap_or_else(|| panic!("not an SVG: {}", &svg[..svg.len().min(300)]))
}

fn is_blank(image: &Image) -> bool {
    image.rgba.as_chunks::<4>().0.windows(2).all(|w| w[0] == w[1])
}

/// Four grains that had escaped left more than half of a picture blank, and stretched the scale of speeds so that all others
/// had one colour; in dark pages slow grains, which are dark, could not be seen at all.
#[test]
fn a_few_that_got_away_do_not_set_the_frame() {
    let mut balls = Balls::of(&fixture::frame(0.0, 400), &Look::default());
    let inside = balls.extent();
    let slow = balls.range().1;
    for grain in 0..4 {
        balls.centres[grain] = [-40.0, -90.0, 0.0];
        balls.values[grain] = 1e3 * slow;
    }
    let window = balls.extent();
    assert!(window.iter().zip(inside).all(|(a, b)| (a - b).abs() < 0.02), "{window:?} for {inside:?}");
    let look = tsubu_report::balls::common(std::slice::from_ref(&balls), &Look::default());
    assert!(look.range.expect("range").1 <= slow, "{:?}", look.range);
    let svg = tsubu_report::strip::picture(&balls, &Look::default());
    assert!(svg.contains(">≥ "), "that colours end below the fastest is said");
    assert!(svg.contains("fill=\"#fff\"/>"), "dark grains stand on white in any page");
}

#[test]
fn one_point_none_and_flat_lines_are_drawn() {
    let axis = || Axis::new("x", "-");
    let with = |points| Figure::new("", axis(), axis()).with(Series::line("s", points));
    for points in [vec![], vec![(1.0, 1.0)], vec![(0.0, 2.0), (1.0, 2.0)], vec![(f64::NAN, 0.0)]] {
        drawable(&with(points).to_svg());
    }
    assert!(with(vec![(f64::NAN, 0.0)]).is_empty());
    assert!(!with(vec![(0.0, 0.0)]).is_empty());
    drawable(&Figure::of_bars("", axis(), Bars::default()).to_svg());
}

#[test]
fn a_long_history_keeps_its_peaks_and_stays_small() {
    let mut points: Vec<_> = (0..200_000).map(|i| (f64::from(i), (f64::from(i) * 0.01).sin())).collect();
    points[123_456].1 = 50.0;
    let svg = Figure::new("", Axis::new("t", "s"), Axis::new("y", "-")).with(Series::line("", points)).to_svg();
    assert!(svg.len() < 150_000, "{} bytes", svg.len());
    assert!(svg.contains(">50<") || svg.contains(">60<"), "the axis reaches the peak");
}

#[test]
fn prefixes_make_short_numbers() {
    assert_eq!(prefix("m", 0.0041), (1e3, "mm".into()));
    assert_eq!(prefix("m", 2.0), (1.0, "m".into()));
    assert_eq!(prefix("m", 3e-6), (1e6, "µm".into()));
    assert_eq!(prefix("J", 2.5e4), (1e-3, "kJ".into()));
    assert_eq!(prefix("-", 1e-9), (1.0, "-".into()));
    assert_eq!(prefix("m", f64::NAN), (1.0, "m".into()));
}

#[test]
fn numbers_read_well() {
    let cases = [
        (0.0, "0"),
        (4.083_61, "4.084"),
        (-0.05, "−0.05"),
        (2.7e-7, "2.7·10⁻⁷"),
        (123_456.7, "123\u{202f}457"),
        (1e9, "1·10⁹"),
        (100.0, "100"),
        (f64::NAN, "–"),
        (999.96, "1000"),
    ];
    for (x, text) in cases {
        assert_eq!(short(x), text, "{x}");
    }
    assert_eq!(count(1_234_567), "1\u{202f}234\u{202f}567");
    assert_eq!(
        (duration(0.0213), duration(75.0), duration(605.0)),
        ("21.3 ms".into(), "75 s".into(), "10 min 05 s".into())
    );
    assert_eq!(escape("<a b='c'>&\u{8}"), "&lt;a b=&#39;c&#39;&gt;&amp;\u{fffd}");
}

#[test]
fn a_strip_shows_every_panel_in_one_scale() {
    let look = Look { arrows: true, ..Look::default() };
    let panels: Vec<_> = (0..8)
        .map(|i| Panel {
            balls: Balls::of(&fixture::frame(4.0 + 0.06 * f64::from(i), 30), &look),
            label: format!("{}° & <", 45 * i),
            arrow: Some([0.01 * f64::from(i - 4), 0.0]),
        })
        .collect();
    let svg = strip(&panels, &look, 4);
    assert!(!is_blank(&drawable(&svg)));
    assert_eq!(svg.matches("stroke-linejoin=\"round\"").count(), 8, "eight boxes");
    assert_eq!(svg.matches("<linearGradient").count(), 1, "one scale");
    drawable(&strip(&[], &look, 8));
}

#[test]
fn many_grains_go_into_pixels() {
    let balls = Balls::of(&fixture::frame(1.0, 4000), &Look::default());
    let svg = strip(&[Panel { balls, ..Panel::default() }], &Look::default(), 1);
    assert!(svg.contains("data:image/png;base64,") && !svg.contains("<circle"));
}

#[test]
fn a_sphere_is_where_it_should_be_and_hides_what_is_behind() {
    let balls = Balls {
        centres: vec![[0.25, 0.75, 0.0], [0.25, 0.75, -1.0], [f64::NAN, 0.0, 0.0]],
        radii: vec![0.1; 3],
        values: vec![1.0, 0.0, 0.0],
        ..Balls::default()
    };
    let look = Look { window: Some([0.0, 0.0, 1.0, 1.0]), range: Some((0.0, 1.0)), ..Look::default() };
    let image = spheres(&balls, &look, 106, 106);
    let pixel = |x: usize, y: usize| &image.rgba[4 * (y * 106 + x)..][..4];
    let [r, g, b, a] = pixel(28, 28) else { panic!() };
    assert!(*a == 255 && r > b && g > b, "the near one is yellow: {r} {g} {b}");
    assert_eq!(pixel(80, 80)[3], 0);
    let edge = (0..106).filter(|x| !matches!(pixel(*x, 22)[3], 0 | 255)).count();
    assert!((2..=4).contains(&edge), "both edges are smooth: {edge}");
}

#[test]
fn pictures_become_png_gif_and_apng() {
    let look = Look { colour: ColourBy::Column("radius".into()), ..Look::default() };
    let series: Vec<_> = [0.0, 1.0, 1.1].map(|t| Balls::of(&fixture::frame(t, 30), &look)).into();
    let look = common(&series, &look);
    let pictures: Vec<_> = series.iter().map(|b| picture(b, &look, 200)).collect();
    assert!(!is_blank(&pictures[0]));
    let png = pictures[0].to_png();
    let back = png::Decoder::new(std::io::Cursor::new(&png)).read_info().unwrap();
    assert_eq!((back.info().width, back.info().height), (200, pictures[0].height));
    let moving = apng(&pictures, 10.0).unwrap();
    let back = png::Decoder::new(std::io::Cursor::new(&moving)).read_info().unwrap();
    assert_eq!(back.info().animation_control().unwrap().num_frames, 3);
    let moving = gif(&pictures, 10.0).unwrap();
    let mut back = gif::DecodeOptions::new().read_info(moving.as_slice()).unwrap();
    let mut frames = 0;
    while back.read_next_frame().unwrap().is_some() {
        frames += 1;
    }
    assert_eq!(frames, 3);
    assert!(gif(&[], 10.0).is_err());
    assert!(apng(&[Image::filled(2, 2, [0; 4]), Image::filled(3, 2, [0; 4])], 1.0).is_err());
}

#[test]
fn views_turn_the_right_way() {
    let mut frame = tsubu_frame::Frame::default();
    let points = vec![[0.0, 0.0, 0.0], [1.0, 2.0, 3.0]];
    frame.vector(Kind::Grain, "position", "m", points);
    let seen = |view| Balls::of(&frame, &Look { view, ..Look::default() }).centres[1];
    assert_eq!(seen(View::Front), [1.0, 2.0, 3.0]);
    assert_eq!(seen(View::Side), [1.0, 3.0, -2.0]);
    let [_, up, _] = seen(View::Slant);
    assert!(up > 0.0);
    assert_eq!(seen(View::Auto), seen(View::Slant));
}

/// Two grains with outlines, seen along y: a square and, beside it, a bar that stands on end.
fn outlined(shape: Vec<i64>) -> Balls {
    let mut frame = tsubu_frame::Frame::default();
    let count = shape.len();
    frame.vector(Kind::Grain, "position", "m", (0..count).map(|i| [i as f64, 0.0, 0.0]).collect());
    frame.vector(Kind::Grain, "velocity", "m/s", vec![[0.0; 3]; count]);
    frame.scalar(Kind::Grain, "radius", "m", vec![0.4; count]);
    frame.integer(Kind::Grain, "shape", "-", shape);
    let rectangle = |x: f64, z: f64| [[-x, 0.0, -z], [x, 0.0, -z], [x, 0.0, z], [-x, 0.0, z]];
    frame.integer(Kind::Global, "shape of corner", "-", vec![3, 3, 3, 3, 7, 7, 7, 7]);
    frame.vector(Kind::Global, "corner", "m", [rectangle(0.4, 0.4), rectangle(0.1, 0.9)].concat());
    Balls::of(&frame, &Look::default())
}

#[test]
fn grains_with_outlines_are_drawn_by_them() {
    let balls = outlined(vec![3, 7]);
    assert_eq!(balls.extent(), [-0.4, -0.9, 1.1, 0.9]);
    let svg = strip(&[Panel { balls: balls.clone(), ..Panel::default() }], &Look::default(), 1);
    assert_eq!((svg.matches("<path d=\"M").count(), svg.matches("<circle").count()), (2, 0));
    drawable(&svg);
    // A picture of 200 pixels a metre: inside the square's corner, which its disc leaves out, and beside the bar, which its
    // disc would cover.
    let look = Look { window: Some([-0.5, -1.0, 1.5, 1.0]), ..Look::default() };
    let image = spheres(&balls, &look, 424, 424);
    let alpha = |x: f64, z: f64| {
        let (column, row) = ((212.0 + 200.0 * (x - 0.5)) as usize, (212.0 - 200.0 * z) as usize);
        image.rgba[4 * (424 * row + column) + 3]
    };
    assert_eq!((alpha(0.38, 0.38), alpha(1.0, 0.85)), (255, 255));
    assert_eq!((alpha(1.3, 0.0), alpha(0.45, 0.0)), (0, 0));
    // A shape that the frame does not draw is a disc.
    let discs = outlined(vec![3, 8]);
    let svg = strip(&[Panel { balls: discs, ..Panel::default() }], &Look::default(), 1);
    assert_eq!((svg.matches("<path d=\"M").count(), svg.matches("<circle").count()), (1, 1));
}

/// One grain behind a triangle, seen in space.
fn behind_a_wall() -> Balls {
    Balls {
        centres: vec![[0.0, 0.0, 0.0]],
        radii: vec![0.2],
        values: vec![0.0],
        faces: vec![[[-1.0, -1.0, 1.0], [1.0, -1.0, 1.0], [0.0, 1.0, 1.0]]],
        space: true,
        ..Balls::default()
    }
}

#[test]
fn walls_in_space_let_grains_shine_through() {
    let pixel = |balls: &Balls, x: usize, y: usize| {
        let image = spheres(balls, &Look::default(), 100, 100);
        let at = 4 * (y * 100 + x);
        [0, 1, 2, 3].map(|k| image.rgba[at + k])
    };
    let veiled = behind_a_wall();
    let mut before = behind_a_wall();
    before.faces[0].iter_mut().for_each(|corner| corner[2] = -1.0);
    // The grain is whole either way, paler where the wall is before it.
    let (through, bare) = (pixel(&veiled, 50, 50), pixel(&before, 50, 50));
    assert_eq!((through[3], bare[3]), (255, 255));
    assert!(through[0] > bare[0] && through[0] < 150, "{through:?} {bare:?}");
    // The wall alone is seen, and seen through; beside it is nothing.
    let wall = pixel(&veiled, 50, 85);
    assert!(wall[3] > 60 && wall[3] < 200, "{wall:?}");
    assert_eq!(pixel(&veiled, 5, 20)[3], 0);
}

#[test]
fn an_empty_moment_says_nothing_about_window_and_scale() {
    let full = behind_a_wall();
    // Before the first grain comes there may be a floor alone, which has no height.
    let floor = Balls { outlines: vec![vec![[-0.5, 0.0, 0.0], [0.5, 0.0, 0.0]]], ..Balls::default() };
    assert_eq!(floor.extent(), [-0.5, 0.0, 0.5, 0.0]);
    let look = common(&[Balls::default(), floor, full.clone()], &Look::default());
    assert_eq!(look.window, Some(full.extent()));
    assert_eq!(look.range, Some((0.0, 0.0)));
}

/// A level surface of water fills the picture below it and makes room for itself where it is near; arrows tell axes, gravity and
/// flow. A surface far above, and a frame that tells nothing, change nothing.
#[test]
fn pictures_show_water_and_which_way_is_which() {
    let wet = |level: f64| {
        let mut frame = fixture::frame(1.0, 30);
        let corners = frame.vectors(Kind::Surface, "position").len() as i64;
        frame.columns.retain(|column| column.kind != Kind::Surface);
        frame.vector(Kind::Surface, "position", "m", vec![[-1.0, 0.0, level], [1.0, 0.0, level]]);
        frame.integer(Kind::Surface, "outline", "-", vec![corners; 2]);
        frame.integer(Kind::Surface, "face", "-", vec![0; 2]);
        frame.integer(Kind::Surface, "wall", "-", vec![-1; 2]);
        frame.integer(Kind::Surface, "endless", "-", vec![1; 2]);
        frame.vector(Kind::Global, "gravity", "m/s^2", vec![[0.0, 0.0, -9.8]]);
        frame.vector(Kind::Global, "flow", "-", vec![[1.0, 0.0, 0.0]]);
        Balls::of(&frame, &Look { view: View::Side, ..Look::default() })
    };
    let top = wet(1e9).extent()[3];
    let near = wet(top + 0.01);
    assert_eq!((near.extent()[3], wet(1e3).extent()[3]), (top + 0.01, top));
    assert_eq!((near.compass.gravity, near.compass.flow), (Some([0.0, -1.0]), Some([1.0, 0.0])));
    let svg = strip(&[Panel { balls: near, ..Panel::default() }], &Look::default(), 1);
    assert!(
        ["fill-opacity=\".09\"", ">gravity<", ">flow<", ">x<", ">z<"].iter().all(|part| svg.contains(part)),
        "{svg}"
    );
    assert!(!svg.contains(">y<"), "an axis that looks at the viewer");
    drawable(&svg);
    let dry = Balls::of(&fixture::frame(1.0, 30), &Look::default());
    let svg = strip(&[Panel { balls: dry, ..Panel::default() }], &Look::default(), 1);
    assert!(![">gravity<", ">flow<", "fill-opacity=\".09\""].iter().any(|part| svg.contains(part)));
}

mod patient {
    use super::*;

    #[test]
    #[ignore = "6 s: cargo xtask patient"]
    fn figures_take_any_numbers() {
        let wild = [f64::NAN, f64::INFINITY, -1.0, 0.0, 1e-300, 1.0, 1e300];
        let points: Vec<_> = wild.iter().map(|x| (*x, *x)).collect();
        for log in [false, true] {
            for style in [Style::Line, Style::Dashed, Style::Points, Style::LineAndPoints] {
                let axis = Axis { log, ..Axis::new("x < \"y\" & z", "m") };
                let figure = Figure::new("a & b <c>", axis.clone(), axis)
                    .with(Series::line("one <", points.clone()).styled(style).with_band(points.clone()))
                    .marked(Mark::vertical(1.0, "<mark>"))
                    .marked(Mark::horizontal(0.5, ""));
                drawable(&figure.to_svg());
                drawable(&figure.to_inline_svg());
            }
        }
    }
}
