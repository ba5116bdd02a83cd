//! What references on the CPU have said, so that none is asked the same thing twice.

use std::collections::{BTreeMap, HashMap};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};
use std::time::{Duration, Instant};

use tyndall_plugin::scene::{Fields, Moment};
use tyndall_plugin::{Numbers, Reference, ReferenceInput};
use tyndall_shaders::scene::{Scene, Surfaces};

/// What a reference has said, or why it could not.
type ReferenceResult = Result<Arc<BTreeMap<&'static str, Numbers>>, String>;

/// Asks references on the CPU for one session, and counts the time that it takes.
pub(crate) struct CachedReferences {
    known: Arc<Mutex<Known>>,
    took: Mutex<Duration>,
}

/// What references have said, by what they were asked: each answer is worked out once, by the session that asks first, while
/// others may ask something else.
#[derive(Default)]
pub(crate) struct Known {
    answers: HashMap<u64, Arc<OnceLock<ReferenceResult>>>,
    scenes: Distinct<Scene>,
    surfaces: Distinct<Surfaces>,
    /// Of plugins, with their places among all that can hold some.
    fields: Distinct<Vec<(usize, Fields)>>,
}

impl CachedReferences {
    /// Shares what is known with other sessions.
    pub fn sharing(known: &Arc<Mutex<Known>>) -> Self {
        Self { known: known.clone(), took: Mutex::default() }
    }

    /// What the reference of a pass says of these inputs.
    pub fn of(&self, pass: &str, reference: Reference, input: &ReferenceInput<'_>) -> ReferenceResult {
        let answer = locked(&self.known).answer(pass, input);
        answer.get_or_init(|| reference(input).map(Arc::new)).clone()
    }

    /// Does what belongs to asking a reference, and counts the time that it takes.
    pub fn timed<T>(&self, ask: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let answer = ask();
        *locked(&self.took) += start.elapsed();
        answer
    }

    /// The time that asking took so far.
    pub fn took(&self) -> Duration {
        *locked(&self.took)
    }
}

pub(crate) fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Known {
    /// The answer to a question, which nobody may have worked out yet.
    fn answer(&mut self, pass: &str, input: &ReferenceInput<'_>) -> Arc<OnceLock<ReferenceResult>> {
        let question = self.question(pass, input);
        self.answers.entry(question).or_default().clone()
    }

    /// A number for all that a reference is asked: the same for equal questions alone.
    fn question(&mut self, pass: &str, input: &ReferenceInput<'_>) -> u64 {
        let mut hasher = DefaultHasher::new();
        (pass, &input.resources).hash(&mut hasher);
        for (name, data) in &input.inputs {
            (name, data.resource, data.scalar, &data.bytes).hash(&mut hasher);
        }
        for (name, value) in &input.params {
            (name, value.to_string()).hash(&mut hasher);
        }
        input.scene.map(|scene| self.scenes.number_of(scene)).hash(&mut hasher);
        input.moment.map(|moment| self.of_fields(moment)).hash(&mut hasher);
        input.surfaces.map(|surfaces| self.surfaces.number_of(surfaces)).hash(&mut hasher);
        hasher.finish()
    }

    /// The number of the fields that plugins have brought, and the time where one of them differs between times.
    fn of_fields(&mut self, moment: &Moment<'_>) -> (usize, Option<u64>) {
        let given = moment.scene.plugin_fields().enumerate().filter(|(_, fields)| !fields.is_empty());
        let fields: Vec<(usize, Fields)> = given.map(|(place, fields)| (place, fields.clone())).collect();
        let varies = fields.iter().any(|(_, fields)| fields.any_varies());
        (self.fields.number_of(&fields), varies.then_some(moment.time.to_bits()))
    }
}

/// Values that differ from one another, each with a number.
struct Distinct<T>(Vec<T>);

impl<T> Default for Distinct<T> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<T: Clone + PartialEq> Distinct<T> {
    /// The number of this value, and of any that equals it.
    fn number_of(&mut self, value: &T) -> usize {
        self.0.iter().position(|known| known == value).unwrap_or_else(|| {
            self.0.push(value.clone());
            self.0.len() - 1
        })
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;
    use std::sync::atomic::{AtomicUsize, Ordering};

    use glam::DVec3;
    use tyndall_document::{Source, render_text};
    use tyndall_plugin::Outputs;
    use tyndall_plugin::scene::animate::Animated;
    use tyndall_plugin::scene::read::{Range, animated_number};
    use tyndall_plugin::scene::{Extension, Extensions, Overrides, Scene as Loaded, SceneField};
    use tyndall_shaders::phase::{PhaseTable, phase};
    use tyndall_shaders::scene::{Camera, HeightFog, Medium, Phase, Scene};

    use super::*;

    fn scene(phase: Phase) -> Scene {
        let camera =
            Camera { position: DVec3::ZERO, nearest: 1e-6, right: DVec3::X, up: DVec3::Y, forward: DVec3::NEG_Z };
        Scene {
            camera,
            medium: Medium { extinction: DVec3::ONE, albedo: DVec3::ONE, phase },
            height_fog: HeightFog::NONE,
            ambient: DVec3::ZERO,
            background: DVec3::ZERO,
            lights: Vec::new(),
            casters: Vec::new(),
            shininesses: Vec::new(),
        }
    }

    fn table(forward: f64) -> Phase {
        Phase::Measured(PhaseTable::new(&[(0.0, forward), (90.0, 1.0), (180.0, 1.0)]).expect("it is a phase function"))
    }

    fn input(scene: Option<&Scene>) -> ReferenceInput<'_> {
        let (inputs, resources, params) = Default::default();
        ReferenceInput { inputs, resources, params, scene, moment: None, surfaces: None }
    }

    static ASKED: AtomicUsize = AtomicUsize::new(0);

    /// The phase function straight ahead.
    fn forward(input: &ReferenceInput<'_>) -> Outputs {
        ASKED.fetch_add(1, Ordering::Relaxed);
        Ok(BTreeMap::from([("p", vec![phase(&input.scene()?.medium.phase, 0.0) as f32].into())]))
    }

    #[test]
    fn measured_phase_functions_of_equal_length_have_answers_of_their_own() {
        let answers = CachedReferences::sharing(&Arc::default());
        let of = |forward_peak: f64| {
            let scene = scene(table(forward_peak));
            answers.of("pass", forward, &input(Some(&scene))).expect("it has a scene")["p"].exact()[0]
        };
        assert_ne!(of(2.0), of(50.0));
        assert_eq!((of(2.0), ASKED.load(Ordering::Relaxed)), (of(2.0), 2), "each is asked once");
    }

    const GLOW: SceneField<Loaded, Animated<f64>> =
        SceneField::new("glow", |reader, node| animated_number(reader, node, "glow", Range::Any));

    /// The field of a plugin.
    fn glow(input: &ReferenceInput<'_>) -> Outputs {
        let moment = input.moment()?;
        let level = GLOW.of(moment.scene).map_or(0.0, |glow| glow.at(moment.time));
        Ok(BTreeMap::from([("p", vec![level as f32].into())]))
    }

    /// What shaders are given of these scenes is the same; what a plugin reads of them is not, and not at all times.
    #[test]
    fn fields_of_plugins_are_a_part_of_the_question() {
        let mut extension = Extension::default();
        extension.add_field(&GLOW);
        let mut extensions = Extensions::default();
        extensions.add("glow", extension).expect("nothing clashes");
        let (answers, extensions) = (CachedReferences::sharing(&Arc::default()), Arc::new(extensions));
        let of = |value: &str, time: f64| {
            let text = format!("(camera: (position: (0, 0, 1), look_at: (0, 0, 0)), glow: {value})");
            let source = Source::new("glow.scene.ron", text);
            let read = Loaded::from_source(&source, Path::new("."), &Overrides::new(), &extensions);
            let loaded = read.unwrap_or_else(|mistakes| panic!("{}", render_text(&mistakes, false))).0;
            let (moment, scene) = (loaded.moment(time, 1.0), loaded.twin(time, 1.0));
            let asked = ReferenceInput { moment: Some(&moment), ..input(Some(&scene)) };
            answers.of("pass", glow, &asked).expect("it has a scene")["p"].exact()[0]
        };
        assert_eq!((of("1", 0.0), of("2", 0.0)), (1.0, 2.0));
        let keys = "Keys([(0, 0), (2, 1)])";
        assert_eq!((of(keys, 0.0), of(keys, 1.0)), (0.0, 0.5));
    }

    /// Whether another reference runs at the same time.
    fn meets_another(_: &ReferenceInput<'_>) -> Outputs {
        static RUNNING: AtomicUsize = AtomicUsize::new(0);
        RUNNING.fetch_add(1, Ordering::SeqCst);
        let start = Instant::now();
        while RUNNING.load(Ordering::SeqCst) < 2 {
            if start.elapsed() > Duration::from_secs(20) {
                return Err("alone".to_owned());
            }
            std::thread::yield_now();
        }
        Ok(BTreeMap::new())
    }

    #[test]
    fn references_of_two_threads_run_side_by_side() {
        let answers = CachedReferences::sharing(&Arc::default());
        let ask = |pass: &str| answers.of(pass, meets_another, &input(None));
        let both = std::thread::scope(|scope| ["a", "b"].map(|pass| scope.spawn(move || ask(pass))).map(|a| a.join()));
        assert!(both.iter().all(|answer| answer.as_ref().is_ok_and(|answer| answer.is_ok())));
    }
}
