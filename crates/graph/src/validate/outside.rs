//! What either the file or the command line gives: the scene and the size of the frame.

use tyndall_document::{BAD_SIZE, Diagnostic, Place};

use super::Request;
use super::mistakes::Mistakes;
use super::scope::{Scope, missing_file};

/// Path of the scene, relative to the working directory.
pub(super) fn scene(scope: &Scope<'_>, out: &mut Mistakes) -> Option<String> {
    if let Some(scene) = &scope.request.overrides.scene {
        return Some(scene.clone());
    }
    let scene = scope.file.scene.as_ref()?;
    let path = scope.beside_file(&scene.value);
    if !scope.exists(&path) {
        out.report(missing_file(&path, scope.place(scene.span)));
    }
    Some(path)
}

/// Size of the frame in pixels.
pub(super) fn size(request: &Request<'_>, out: &mut Mistakes) -> (u32, u32) {
    let Some((width, height)) = request.overrides.size else {
        return request.file.size.as_ref().map_or((640, 480), |size| size.value);
    };
    if width == 0 || height == 0 {
        let place = Place::Argument(format!("--size {width}x{height}"));
        let message = format!("the size must be at least 1×1, got {width}×{height}");
        out.report(Diagnostic::error(BAD_SIZE, place, message));
    }
    (width, height)
}
