//! The values of a plan's parameters, from frame to frame.

use tyndall_graph::descriptor::{ParamDescriptor, ParamType, ParamValue};
use tyndall_graph::{Handle, ParamSetting, Plan, PlannedPass, Table, Values};

use crate::error::GpuError;

/// Frame n shows time n over this.
pub const FRAMES_PER_SECOND: f64 = 24.0;

/// The values of all parameters.
pub(crate) struct Parameters {
    values: Table<PlannedPass, Values>,
    live: Vec<Live>,
}

/// A parameter that changes with the frame.
struct Live {
    pass: Handle<PlannedPass>,
    param: Handle<ParamDescriptor>,
    setting: ParamSetting,
}

impl Parameters {
    /// As they are in frame 0.
    pub fn new(plan: &Plan) -> Self {
        let settings = plan.passes.handles().flat_map(|pass| {
            let settings = plan.params(pass).entries();
            settings.map(move |(param, setting)| Live { pass, param, setting: setting.clone() })
        });
        let live = settings.filter(|live| !matches!(live.setting, ParamSetting::Value(_))).collect();
        Self { values: plan.values(0, 0.0), live }
    }

    pub fn values(&self) -> &Table<PlannedPass, Values> {
        &self.values
    }

    /// Sets those that change with the frame.
    pub fn follow(&mut self, frame: u32) {
        let seconds = f64::from(frame) / FRAMES_PER_SECOND;
        for Live { pass, param, setting } in &self.live {
            self.values[*pass][*param] = setting.value(frame, seconds);
        }
    }

    /// Sets one from now on, in all frames.
    pub fn set(&mut self, plan: &Plan, (pass, param): (&str, &str), value: ParamValue) -> Result<(), GpuError> {
        let refuse = |reason: &str| GpuError::Pass { pass: pass.to_owned(), reason: format!("`{param}` {reason}") };
        let at = plan.passes.handles().find(|position| plan.pass_name(*position) == pass);
        let at = at.ok_or_else(|| refuse("belongs to no pass of the plan"))?;
        let descriptor = plan.descriptor(at);
        let index = descriptor.param_named(param).ok_or_else(|| refuse("is not a parameter of it"))?;
        let declared = &descriptor.params[index];
        if declared.fixed {
            return Err(refuse("is a part of the pipeline: plan anew to change it"));
        }
        if declared.accepts == ParamType::File {
            return Err(refuse("names a file that was read already: plan anew to change it"));
        }
        declared.check(&value).map_err(|refusal| refuse(&refusal.to_string()))?;
        self.values[at][index] = value;
        self.live.retain(|live| (live.pass, live.param) != (at, index));
        Ok(())
    }
}
