//! What stands before the pixels of a Radiance file (Ward, "Radiance File Formats").

/// What stands before the pixels, and the pixels.
#[derive(Debug)]
pub(crate) struct Header<'a> {
    /// Number of scanlines.
    pub lines: u32,
    /// Pixels in a scanline.
    pub length: u32,
    pub order: Order,
    /// Stored numbers over radiance, for red, green and blue: the product of all EXPOSURE and COLORCORR.
    pub scale: [f64; 3],
    /// As they are stored.
    pub pixels: &'a [u8],
}

/// The order in which scanlines follow each other, and the pixels in each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Order {
    /// Scanlines are columns and not rows.
    columns: bool,
    /// The first one is at the bottom, or at the right.
    from_end: bool,
    /// And so is the first pixel of each.
    pixels_from_end: bool,
}

impl Order {
    /// Of a resolution such as `-Y 480 +X 640`: y runs up, x to the right.
    fn of(lines: &str, pixels: &str) -> Option<Self> {
        let axis = |text: &str| match text {
            "+X" => Some((true, false)),
            "-X" => Some((true, true)),
            "-Y" => Some((false, false)),
            "+Y" => Some((false, true)),
            _ => None,
        };
        let ((columns, from_end), (along_x, pixels_from_end)) = (axis(lines)?, axis(pixels)?);
        (columns != along_x).then_some(Self { columns, from_end, pixels_from_end })
    }

    /// Width and height of a picture with so many scanlines of so many pixels.
    pub fn size(self, lines: u32, length: u32) -> [u32; 2] {
        if self.columns { [lines, length] } else { [length, lines] }
    }

    /// Where the pixel at x and y, from the top left, is stored.
    pub fn index(self, [x, y]: [u32; 2], lines: u32, length: u32) -> usize {
        let (mut line, mut pixel) = if self.columns { (x, y) } else { (y, x) };
        if self.from_end {
            line = lines - 1 - line;
        }
        if self.pixels_from_end {
            pixel = length - 1 - pixel;
        }
        line as usize * length as usize + pixel as usize
    }
}

impl<'a> Header<'a> {
    /// Reads a header. Its first line is `#?` and the name of the program or format: `#?RADIANCE`, `#?RGBE`.
    pub fn read(bytes: &'a [u8]) -> Result<Self, String> {
        let mut rest = bytes;
        let name = line(&mut rest).filter(|line| line.starts_with("#?"));
        if name.is_none() {
            return Err("not a valid HDR file: it does not begin with `#?RADIANCE` or `#?RGBE`".to_owned());
        }
        let mut scale = [1.0; 3];
        loop {
            let line = line(&mut rest).ok_or("not a valid HDR file: its header does not end")?;
            if line.is_empty() {
                break;
            }
            // Lines without `=` say which commands made the picture.
            let Some((name, value)) = line.split_once('=') else { continue };
            match name.trim() {
                "FORMAT" if value.trim() != "32-bit_rle_rgbe" => {
                    return Err(format!("colours as `{}` are not read", value.trim()));
                }
                "EXPOSURE" => multiply(&mut scale, value, 1).ok_or_else(|| unusable(&line))?,
                "COLORCORR" => multiply(&mut scale, value, 3).ok_or_else(|| unusable(&line))?,
                _ => {}
            }
        }
        let resolution = line(&mut rest).unwrap_or_default();
        let (order, lines, length) = order(&resolution)
            .ok_or_else(|| format!("not a valid HDR file: its size is `{resolution}`, and not `-Y HEIGHT +X WIDTH`"))?;
        Ok(Self { lines, length, order, scale, pixels: rest })
    }
}

/// Takes the next line off, without its end.
fn line(rest: &mut &[u8]) -> Option<String> {
    let end = rest.iter().position(|byte| *byte == b'\n')?;
    let text = String::from_utf8_lossy(&rest[..end]).trim_end_matches('\r').to_owned();
    *rest = &rest[end + 1..];
    Some(text)
}

/// Multiplies by one number, or by one for each channel; `None` where these are not so many numbers above 0.
fn multiply(scale: &mut [f64; 3], value: &str, count: usize) -> Option<()> {
    let numbers: Option<Vec<f64>> = value.split_whitespace().map(|number| number.parse().ok()).collect();
    let numbers = numbers.filter(|numbers| numbers.len() == count)?;
    for (channel, scale) in scale.iter_mut().enumerate() {
        *scale *= numbers[channel % count];
    }
    scale.iter().all(|scale| scale.is_finite() && *scale > 0.0).then_some(())
}

fn unusable(line: &str) -> String {
    format!("`{line}` would make no number of radiance: it must be above 0")
}

/// The order, the number of scanlines, and their length.
fn order(resolution: &str) -> Option<(Order, u32, u32)> {
    let parts: Vec<&str> = resolution.split_whitespace().collect();
    let &[first, lines, second, length] = parts.as_slice() else { return None };
    Some((Order::of(first, second)?, lines.parse().ok()?, length.parse().ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn header(lines: &str) -> Result<Header<'_>, String> {
        Header::read(lines.as_bytes())
    }

    #[test]
    fn all_exposures_and_corrections_are_multiplied() {
        let text = "#?RGBE\nmade by hand\nEXPOSURE=2.0\nEXPOSURE= 4\nCOLORCORR=1 2 0.5\n\n-Y 3 +X 5\nxyz";
        let read = header(text).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!((read.lines, read.length, read.scale, read.pixels), (3, 5, [8.0, 16.0, 4.0], &b"xyz"[..]));
        for wrong in ["EXPOSURE=0", "EXPOSURE=-1", "EXPOSURE=much", "EXPOSURE=nan", "COLORCORR=1 1", "EXPOSURE="] {
            let error = header(&format!("#?RADIANCE\n{wrong}\n\n-Y 1 +X 1\n")).err().unwrap_or_default();
            assert!(error.contains(wrong), "{wrong}: {error}");
        }
    }

    #[test]
    fn what_is_not_read_is_named() {
        for (text, expected) in [
            ("RADIANCE\n\n-Y 1 +X 1\n", "does not begin with `#?RADIANCE`"),
            ("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n", "`32-bit_rle_xyze` are not read"),
            ("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n", "does not end"),
            ("#?RADIANCE\n\n-Y 1 -Y 1\n", "its size is `-Y 1 -Y 1`"),
            ("#?RADIANCE\n\n-Y 1 +X -1\n", "its size is `-Y 1 +X -1`"),
            ("#?RADIANCE\n\n", "its size is ``"),
        ] {
            let error = header(text).err().unwrap_or_default();
            assert!(error.contains(expected), "{text}: {error}");
        }
    }

    /// Of a picture of 3 by 2 pixels, the scanline and the pixel in it at the top left, and at the top right.
    #[test]
    fn eight_orders() {
        for (resolution, size, corners) in [
            ("-Y 2 +X 3", [3, 2], [0, 2]),
            ("-Y 2 -X 3", [3, 2], [2, 0]),
            ("+Y 2 +X 3", [3, 2], [3, 5]),
            ("+Y 2 -X 3", [3, 2], [5, 3]),
            ("+X 3 -Y 2", [3, 2], [0, 4]),
            ("-X 3 -Y 2", [3, 2], [4, 0]),
            ("+X 3 +Y 2", [3, 2], [1, 5]),
            ("-X 3 +Y 2", [3, 2], [5, 1]),
        ] {
            let Some((order, lines, length)) = order(resolution) else { panic!("{resolution}") };
            assert_eq!(order.size(lines, length), size, "{resolution}");
            assert_eq!([[0, 0], [2, 0]].map(|pixel| order.index(pixel, lines, length)), corners, "{resolution}");
        }
    }
}
