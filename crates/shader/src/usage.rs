//! Which parameters a shader reads.

use naga::valid::{FunctionInfo, ModuleInfo};
use naga::{Expression, Function, GlobalVariable, Handle, Module, TypeInner};

use crate::naming::PARAMS;

/// Of each member of `params`: whether some function reads it, in a module that holds only functions that are used.
/// Where `params` is read or passed on as a whole, all members count as read.
pub fn members_read(module: &Module, info: &ModuleInfo) -> Vec<bool> {
    let params = module.global_variables.iter().find(|(_, variable)| variable.name.as_deref() == Some(PARAMS));
    let Some((params, variable)) = params else { return Vec::new() };
    let TypeInner::Struct { members, .. } = &module.types[variable.ty].inner else { return Vec::new() };
    let mut read = vec![false; members.len()];
    for (handle, function) in module.functions.iter() {
        mark(function, &info[handle], params, &mut read);
    }
    for (index, entry) in module.entry_points.iter().enumerate() {
        mark(&entry.function, info.get_entry_point(index), params, &mut read);
    }
    read
}

fn mark(function: &Function, info: &FunctionInfo, params: Handle<GlobalVariable>, read: &mut [bool]) {
    let of = |handle| matches!(function.expressions[handle], Expression::GlobalVariable(global) if global == params);
    let mut by_member = 0;
    for (_, expression) in function.expressions.iter() {
        if let Expression::AccessIndex { base, index } = *expression
            && of(base)
        {
            by_member += 1;
            read[index as usize] = true;
        }
    }
    let references = |(handle, _): (Handle<Expression>, _)| if of(handle) { info[handle].ref_count } else { 0 };
    if function.expressions.iter().map(references).sum::<usize>() > by_member {
        read.fill(true);
    }
}
