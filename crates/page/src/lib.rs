//! Pages for people: the page of a comparison and the report of image tests are made of these parts.
//!
//! | part | what |
//! | --- | --- |
//! | [`Page`], [`STYLE`] | the frame of a page, and the style that all have in common |
//! | [`Picture`], [`figure`] | a picture, and what stands below it |
//! | [`false_color`] | colours of errors and differences |
//! | [`plot`], [`curves`] | plots as SVG |
//! | [`escaped`] | text as it stands in HTML, SVG and XML |
//!
//! A page needs nothing but its folder: no server, no script and no font from elsewhere.

pub mod false_color;
mod frame;
mod picture;
mod plot;
mod text;

pub use frame::{Page, STYLE};
pub use picture::{Picture, figure};
pub use plot::{Point, Quantity, Unit, curves, plot};
pub use text::escaped;
