//! Moving pictures: GIF for mail and slides, APNG where all colours matter.

use std::io;

use crate::raster::Image;

/// Pictures of one size, one after the other, without end.
pub fn gif(pictures: &[Image], per_second: f64) -> io::Result<Vec<u8>> {
    let (width, height) = one_size(pictures)?;
    let small = |n: u32| u16::try_from(n).map_err(|_| io::Error::other("a GIF is at most 65535 pixels wide"));
    let (width, height) = (small(width)?, small(height)?);
    let mut out = Vec::new();
    {
        let mut encoder = gif::Encoder::new(&mut out, width, height, &[]).map_err(io::Error::other)?;
        encoder.set_repeat(gif::Repeat::Infinite).map_err(io::Error::other)?;
        for picture in pictures {
            let rgb: Vec<u8> = picture.rgba.as_chunks::<4>().0.iter().flat_map(|p| [p[0], p[1], p[2]]).collect();
            let mut frame = gif::Frame::from_rgb_speed(width, height, &rgb, 10);
            frame.delay = (100.0 / per_second.clamp(1.0, 50.0)).round() as u16;
            encoder.write_frame(&frame).map_err(io::Error::other)?;
        }
    }
    Ok(out)
}

/// The same as APNG.
pub fn apng(pictures: &[Image], per_second: f64) -> io::Result<Vec<u8>> {
    let (width, height) = one_size(pictures)?;
    let mut out = Vec::new();
    let mut encoder = png::Encoder::new(&mut out, width, height);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_animated(pictures.len() as u32, 0).map_err(io::Error::other)?;
    let hundredths = (100.0 / per_second.clamp(1.0, 100.0)).round() as u16;
    encoder.set_frame_delay(hundredths, 100).map_err(io::Error::other)?;
    let mut writer = encoder.write_header().map_err(io::Error::other)?;
    for picture in pictures {
        writer.write_image_data(&picture.rgba).map_err(io::Error::other)?;
    }
    writer.finish().map_err(io::Error::other)?;
    Ok(out)
}

fn one_size(pictures: &[Image]) -> io::Result<(u32, u32)> {
    let first = pictures.first().ok_or_else(|| io::Error::other("an animation needs a picture"))?;
    let size = (first.width, first.height);
    if pictures.iter().all(|p| (p.width, p.height) == size) {
        Ok(size)
    } else {
        Err(io::Error::other("the pictures of an animation differ in size"))
    }
}
