// defocus IN.raw OUT.raw WIDTH HEIGHT LARGEST_PX: IN holds R, G, B, A, signed radius (px) per pixel as f32.
use ndarray::{Array2, Array3};
use opendefocus::{OpenDefocusRenderer, datamodel::{Settings, UVector2, defocus::DefocusMode, render::Quality}};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let words: Vec<String> = std::env::args().collect();
    let (width, height): (usize, usize) = (words[3].parse()?, words[4].parse()?);
    let largest: f32 = words[5].parse()?;
    let bytes = std::fs::read(&words[1])?;
    let values: Vec<f32> = bytes.chunks_exact(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
    let at = |x: usize, y: usize, c: usize| values[(y * width + x) * 5 + c];
    let mut picture = Array3::from_shape_fn((height, width, 4), |(y, x, c)| at(x, y, c));
    let radius = Array2::from_shape_fn((height, width), |(y, x)| at(x, y, 4));
    let mut settings = Settings::default();
    settings.defocus.set_defocus_mode(DefocusMode::Depth);
    settings.defocus.use_direct_math = true;
    settings.defocus.circle_of_confusion.max_size = largest;
    settings.defocus.camera_max_size = largest;
    settings.defocus.size_multiplier = 1.0;
    settings.defocus.proxy_scale = Some(1.0);
    settings.defocus.gamma_correction = 1.0;
    settings.render.set_quality(Quality::Accurate);
    settings.render.set_farm_quality(Quality::Accurate);
    settings.render.resolution = UVector2 { x: width as u32, y: height as u32 };
    pollster::block_on(async {
        let renderer = OpenDefocusRenderer::new(&mut settings).await?;
        eprintln!("device: {:?}", settings.render.device_name);
        renderer.render(settings, picture.view_mut(), Some(radius), None).await
    })?;
    let out: Vec<u8> = picture.iter().flat_map(|v| v.to_le_bytes()).collect();
    Ok(std::fs::write(&words[2], out)?)
}
