//! The image of a map: PGM (plain or raw) or PNG, 8 bits a channel.

use std::cell::Cell;
use std::fs::File;
use std::io::{self, BufReader, ErrorKind, Read, Seek, SeekFrom};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use image::codecs::png::{PngDecoder, PngEncoder};
use image::codecs::pnm::PnmDecoder;
use image::{ColorType, ExtendedColorType, ImageDecoder, ImageEncoder, ImageError, Limits};

use super::diagnostic::{Code, MapErrors, Problem, Text};
use super::ros_map::yaml::{MapFile, Pixel};

/// The most pixels that a map's image may have: 500 m by 500 m at 5 cm. Checked on the header, before any memory
/// is taken.
pub const MAX_PIXELS: u64 = 100_000_000;

pub(crate) struct Image {
    pub(crate) columns: usize,
    pub(crate) rows: usize,
    colour: ColorType,
    bytes: Vec<u8>,
}

impl Image {
    /// The pixels row by row, the lowest row first.
    pub(crate) fn bottom_up(&self) -> impl Iterator<Item = Pixel> + '_ {
        let channels = usize::from(self.colour.channel_count());
        let rows = self.bytes.chunks_exact(self.columns * channels).rev();
        rows.flat_map(move |row| row.chunks_exact(channels)).map(|pixel| match *pixel {
            [grey] => Pixel { colour: f64::from(grey), alpha: None },
            [grey, alpha] => Pixel { colour: f64::from(grey), alpha: Some(alpha) },
            [r, g, b] => Pixel { colour: mean(r, g, b), alpha: None },
            [r, g, b, alpha, ..] => Pixel { colour: mean(r, g, b), alpha: Some(alpha) },
            [] => Pixel { colour: 0.0, alpha: None },
        })
    }

    /// As a PNG in grey whose longer side has at most so many pixels: of those that become one the darkest counts, so that walls stay.
    pub(crate) fn png(&self, most: usize) -> Result<Vec<u8>, ImageError> {
        let step = self.columns.max(self.rows).div_ceil(most.max(1));
        let (columns, rows) = (self.columns.div_ceil(step), self.rows.div_ceil(step));
        let mut grey = vec![u8::MAX; columns * rows];
        for (at, pixel) in self.bottom_up().enumerate() {
            // pictures begin above
            let (column, row) = (at % self.columns, self.rows - 1 - at / self.columns);
            let shade = &mut grey[row / step * columns + column / step];
            *shade = (*shade).min(pixel.colour.round() as u8);
        }
        let mut png = Vec::new();
        let encoder = PngEncoder::new(&mut png);
        encoder.write_image(&grey, columns as u32, rows as u32, ExtendedColorType::L8)?;
        Ok(png)
    }
}

fn mean(r: u8, g: u8, b: u8) -> f64 {
    (f64::from(r) + f64::from(g) + f64::from(b)) / 3.0
}

/// Reads the image that a map file names, relative to `folder`.
pub(crate) fn read_image(source: &Text, file: &MapFile, folder: &Path) -> Result<Image, MapErrors> {
    let problem = |code, what: String| source.problem(code, &file.image_span, what);
    let path = folder.join(&file.image);
    let opened = File::open(&path).and_then(|opened| magic(&path).map(|magic| (opened, magic)));
    let (opened, magic) = opened.map_err(|error| match error.kind() {
        ErrorKind::NotFound => problem(Code::ImageMissing, format!("the image `{}` is missing", file.image))
            .with_help("its path is taken from the folder of the YAML file"),
        _ => problem(Code::Unreadable, format!("the image `{}` cannot be read: {error}", file.image)),
    })?;
    let ended = Cell::new(false);
    let reader = BufReader::new(Watched { file: opened, ended: &ended });
    if !matches!(&magic, b"P2" | b"P5" | b"\x89P") {
        let message = format!("`{}` is not an image that a map can be read from", file.image);
        return Err(problem(Code::NotAnImage, message).with_help("PGM (P2, P5) and PNG are known").into());
    }
    let decoded = || match &magic {
        b"\x89P" => PngDecoder::with_limits(reader, Limits::default())
            .map(|decoder| decode(decoder, &problem, &file.image)),
        _ => PnmDecoder::new(reader).map(|decoder| decode(decoder, &problem, &file.image)),
    };
    // a palette whose length is no multiple of three makes the decoder of PNG panic
    let decoded = catch_unwind(AssertUnwindSafe(decoded)).map_err(|_| {
        let message = format!("the image `{}` cannot be decoded: it is damaged", file.image);
        problem(Code::NotAnImage, message).with_help("copy the file again")
    })?;
    let image = decoded.map_err(Refused::Image).and_then(std::convert::identity);
    image.map_err(|refused| match refused {
        Refused::Map(problem) => problem.into(),
        Refused::Image(_) if ended.get() => {
            let message = format!("the image `{}` is truncated: it ends before its last pixel", file.image);
            problem(Code::ImageTruncated, message).with_help("copy the file again").into()
        }
        Refused::Image(error) => {
            problem(Code::NotAnImage, format!("the image `{}` cannot be decoded: {error}", file.image)).into()
        }
    })
}

/// Why an image is no map.
enum Refused {
    Image(ImageError),
    /// It is an image, but not one of a map.
    Map(Problem),
}

/// A file that remembers that somebody wanted more than there was.
struct Watched<'a> {
    file: File,
    ended: &'a Cell<bool>,
}

impl Read for Watched<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.file.read(buffer)?;
        self.ended.set(self.ended.get() || count == 0 && !buffer.is_empty());
        Ok(count)
    }
}

impl Seek for Watched<'_> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.file.seek(to)
    }
}

fn magic(path: &Path) -> io::Result<[u8; 2]> {
    let mut magic = [0; 2];
    match File::open(path)?.read_exact(&mut magic) {
        Err(error) if error.kind() != ErrorKind::UnexpectedEof => Err(error),
        _ => Ok(magic),
    }
}

fn decode(
    decoder: impl ImageDecoder,
    problem: &impl Fn(Code, String) -> Problem,
    name: &str,
) -> Result<Image, Refused> {
    let (columns, rows) = decoder.dimensions();
    if columns == 0 || rows == 0 {
        return Err(Refused::Map(problem(Code::NotAnImage, format!("the image `{name}` has no pixel"))));
    }
    if u64::from(columns) * u64::from(rows) > MAX_PIXELS {
        let message =
            format!("the image `{name}` has {columns} x {rows} pixels, more than the {MAX_PIXELS} of a map");
        let problem = problem(Code::ImageTooLarge, message);
        return Err(Refused::Map(problem.with_help("use a coarser image of the floor")));
    }
    let colour = decoder.color_type();
    if colour.bytes_per_pixel() > colour.channel_count() {
        let message = format!("the image `{name}` has 16 bits a channel; a map has 8");
        let problem = problem(Code::ImageDepth, message);
        return Err(Refused::Map(problem.with_help("save it with 8 bits (a maxval of 255)")));
    }
    let mut bytes = vec![0; decoder.total_bytes() as usize];
    decoder.read_image(&mut bytes).map_err(Refused::Image)?;
    Ok(Image { columns: columns as usize, rows: rows as usize, colour, bytes })
}
