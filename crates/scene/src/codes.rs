//! The classes of mistakes that this crate reports, besides those of the document crate.

use tyndall_document::codes;

codes! {
    /// Every class of mistake that this crate reports and none below it.
    CODES:
    /// A direction or axis of length 0, or one that passes through 0 between two keys.
    ZERO_DIRECTION = "zero-direction";
    /// `look_at` equals `position`, at a key or between two.
    CAMERA_ON_TARGET = "camera-on-target";
    /// `up` is parallel to the view, at a key or between two.
    UP_ALONG_VIEW = "up-along-view";
    /// A file that holds no phase function.
    PHASE_TABLE = "phase-table";
    /// No camera in the scene file, and none in a glTF file that it names.
    MISSING_CAMERA = "missing-camera";
    /// `Keys([])`.
    EMPTY_KEYS = "empty-keys";
    /// Keys whose times do not ascend.
    UNSORTED_KEYS = "unsorted-keys";
    /// `Keys` for a value that cannot have keys.
    CONSTANT_ONLY = "constant-only";
    /// A `--set scene.…` path into something that has no such part.
    UNKNOWN_PATH = "unknown-path";
    /// A model file that is neither `.glb` nor `.gltf`.
    UNKNOWN_SUFFIX = "unknown-suffix";
    /// More vertices, triangles or texels than scene data may have.
    SCENE_TOO_LARGE = "scene-too-large";
    /// `materials` of an object that has none with names, or a name that no material of its file has.
    NAMED_MATERIALS = "named-materials";
    /// A surface that reflects more light than it receives (a warning).
    BRIGHTER_THAN_WHITE = "brighter-than-white";
    /// glTF: the `.glb` container is broken or cut off.
    GLTF_CONTAINER = "gltf-container";
    /// glTF: the JSON is broken.
    GLTF_SYNTAX = "gltf-syntax";
    /// glTF: a version other than 2.0.
    GLTF_VERSION = "gltf-version";
    /// glTF: an extension is required that is not supported.
    GLTF_EXTENSION = "gltf-extension";
    /// glTF: an element that does not exist.
    GLTF_REFERENCE = "gltf-reference";
    /// glTF: a file that does not exist or cannot be read.
    GLTF_MISSING_FILE = "gltf-missing-file";
    /// glTF: a URI that leaves the folder of the file.
    GLTF_OUTSIDE_FOLDER = "gltf-outside-folder";
    /// glTF: a URI of another scheme, or a broken one.
    GLTF_URI = "gltf-uri";
    /// glTF: offsets, counts or strides beyond the bytes that there are.
    GLTF_BUFFER_RANGE = "gltf-buffer-range";
    /// glTF: an accessor of the wrong type, or with another number of elements than its fellows.
    GLTF_ACCESSOR_TYPE = "gltf-accessor-type";
    /// glTF: a vertex index beyond the vertices, or indices that make no triangles.
    GLTF_INDEX_RANGE = "gltf-index-range";
    /// glTF: NaN or infinity.
    GLTF_NOT_FINITE = "gltf-not-finite";
    /// glTF: a node with two parents, or a cycle.
    GLTF_HIERARCHY = "gltf-hierarchy";
    /// glTF: an invalid node transform.
    GLTF_TRANSFORM = "gltf-transform";
    /// glTF: a picture that cannot be decoded.
    GLTF_IMAGE = "gltf-image";
    /// glTF: more vertices, texels or bytes than are read.
    GLTF_TOO_LARGE = "gltf-too-large";
    /// glTF: points or lines, which are not drawn (a warning), or an unknown mode.
    GLTF_MODE = "gltf-mode";
    /// glTF: material factors out of range.
    GLTF_MATERIAL = "gltf-material";
    /// glTF: an invalid light.
    GLTF_LIGHT = "gltf-light";
    /// glTF: an invalid camera.
    GLTF_CAMERA = "gltf-camera";
    /// glTF: an invalid animation.
    GLTF_ANIMATION = "gltf-animation";
    /// glTF: something that has no part in our pictures (a warning).
    GLTF_IGNORED = "gltf-ignored";
}
