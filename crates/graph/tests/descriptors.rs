//! Descriptors that contradict themselves are refused.

#![allow(clippy::unwrap_used, reason = "a test")]

mod support;

use std::sync::Arc;

use support::{With, input, output, param, pass, port, texture};
use tyndall_graph::descriptor::{
    Axis, Class, Dimension, Disabled, Extent, Format, ParamDescriptor, ParamValue, PassDescriptor, PortDescriptor,
    PortKind, Role, SizeRule,
};
use tyndall_graph::{Catalogue, DescriptorError as E};

fn errors(descriptor: PassDescriptor) -> Vec<E> {
    let mut catalogue = Catalogue::new();
    let name = descriptor.name.clone();
    let errors = catalogue.insert(Arc::new(descriptor)).err().unwrap_or_default();
    assert_eq!(catalogue.get(&name).is_none(), !errors.is_empty());
    for error in &errors {
        assert!(!error.to_string().is_empty());
    }
    errors
}

fn of_ports(ports: Vec<PortDescriptor>) -> Vec<E> {
    errors(pass(
        "test.pass",
        ports,
        vec![param("count", ParamValue::Integer(1), None), param("scale", ParamValue::Float(1.0), None)],
    ))
}

fn of_param(param: ParamDescriptor) -> Vec<E> {
    errors(pass("test.pass", vec![], vec![param]))
}

fn color(name: &str) -> PortDescriptor {
    output(name, Class::Color, Format::Rgba32Float)
}

fn wide(width: Extent) -> SizeRule {
    SizeRule { width, ..SizeRule::fixed(1, 1, 1) }
}

fn names(port: &str, named: &str) -> (String, String) {
    (port.to_owned(), named.to_owned())
}

#[test]
fn the_passes_of_the_tests_are_sound() {
    assert!(support::catalogue().names().is_sorted());
    assert_eq!(of_ports(vec![input("a", Class::Color), color("b").size(SizeRule::same("a"))]), []);
}

#[test]
fn names_are_names_and_stand_once() {
    assert_eq!(errors(pass("Core.x", vec![], vec![])), [E::BadName("Core.x".into())]);
    assert_eq!(of_ports(vec![color("Depth")]), [E::BadName("Depth".into())]);
    assert_eq!(of_ports(vec![color("a"), color("a")]), [E::DuplicatePort("a".into())]);
    let twice = vec![param("x", ParamValue::Bool(true), None), param("x", ParamValue::Bool(true), None)];
    assert_eq!(errors(pass("test.pass", vec![], twice)), [E::DuplicateParam("x".into())]);
    let mut catalogue = support::catalogue();
    let again = catalogue.get("core.add").unwrap().unwrap().clone();
    assert_eq!(catalogue.insert(again), Err(vec![E::DuplicatePass("core.add".into())]));
}

#[test]
fn sizes_name_what_there_is() {
    let (port_a, named) = names("a", "b");
    assert_eq!(of_ports(vec![color("a").size(SizeRule::same("b"))]), [E::UnknownSizePort { port: port_a, named }]);
    let history = port("h", Role::History([0.0; 4]), texture(Class::Color, None));
    let (port_a, named) = names("a", "h");
    assert_eq!(of_ports(vec![history, color("a").size(SizeRule::same("h"))]), [E::HistorySize { port: port_a, named }]);
    let (port_a, named) = names("a", "missing");
    let rule = wide(Extent::Param("missing".into()));
    assert_eq!(of_ports(vec![color("a").size(rule)]), [E::UnknownSizeParam { port: port_a, named }]);
    let (port_a, named) = names("a", "scale");
    let rule = wide(Extent::Param("scale".into()));
    assert_eq!(of_ports(vec![color("a").size(rule)]), [E::SizeParamNotInteger { port: port_a, named }]);
}

#[test]
fn sizes_are_above_zero_and_follow_from_something_else() {
    assert_eq!(of_ports(vec![color("a").size(SizeRule::fixed(1, 0, 1))]), [E::ZeroSize { port: "a".into() }]);
    let rule = wide(Extent::Frame { axis: Axis::X, scale: f64::NAN });
    assert_eq!(of_ports(vec![color("a").size(rule)]), [E::BadScale { port: "a".into() }]);
    let round = vec![color("a").size(SizeRule::same("b")), color("b").size(SizeRule::same("a"))];
    assert_eq!(of_ports(round), [E::SizeCycle { port: "a".into() }, E::SizeCycle { port: "b".into() }]);
}

#[test]
fn outputs_have_a_class_and_a_format() {
    let open = |class| port("a", Role::Output { disabled: Disabled::Constant([0.0; 4]) }, texture(class, None));
    assert_eq!(of_ports(vec![open(Class::Color)]), [E::NoFormat { port: "a".into() }]);
    assert_eq!(of_ports(vec![open(Class::Any)]), [E::NoClass { port: "a".into() }]);
}

#[test]
fn what_flows_through_is_an_input_of_the_same_kind() {
    let (port_a, named) = names("a", "b");
    let through = of_ports(vec![color("a").through("b"), color("b")]);
    assert_eq!(through, [E::UnknownThrough { port: port_a.clone(), named: named.clone() }]);
    let scalar = of_ports(vec![input("b", Class::Scalar), color("a").through("b")]);
    assert_eq!(scalar, [E::ThroughOther { port: port_a.clone(), named: named.clone() }]);
    let volume = PortKind::Texture { dimension: Dimension::D3, class: Class::Color, format: None, filtered: false };
    let volume = of_ports(vec![port("b", Role::Input, volume), color("a").through("b")]);
    assert_eq!(volume, [E::ThroughOther { port: port_a.clone(), named: named.clone() }]);
    let history = port("b", Role::History([0.0; 4]), texture(Class::Color, None));
    let history = of_ports(vec![history, color("a").through("b")]);
    assert_eq!(history, [E::ThroughHistory { port: port_a, named }]);
}

#[test]
fn defaults_are_values_that_the_parameter_may_have() {
    let bad = |errors: Vec<E>| matches!(errors.as_slice(), [E::BadDefault { .. }]);
    assert!(bad(of_param(param("x", ParamValue::Float(2.0), Some((0.0, 1.0))))));
    assert!(bad(of_param(param("x", ParamValue::Float(f64::NAN), None))));
    assert!(bad(of_param(param("x", ParamValue::Integer(-1), Some((0.0, 1.0))))));
    assert!(bad(of_param(param("x", ParamValue::Vector(vec![0.0]), None))));
    let choice = |words: &[&str]| support::choice("x", "a", words);
    assert!(bad(of_param(choice(&["b"]))));
    assert_eq!(of_param(choice(&[])), [E::NoChoices("x".into())]);
    assert_eq!(of_param(choice(&["b", "a"])), []);
}

#[test]
fn rules_say_what_they_mean() {
    let words = |rule: SizeRule| rule.to_string();
    assert_eq!(words(SizeRule::frame(1.0)), "the frame's size");
    assert_eq!(words(SizeRule::frame(0.5)), "0.5 × the frame's size");
    assert_eq!(words(SizeRule::same("depth")), "the size of `depth`");
    assert_eq!(words(SizeRule::scaled("depth", 0.25)), "0.25 × the size of `depth`");
    assert_eq!(words(SizeRule::fixed(64, 32, 1)), "64 × 32");
    assert_eq!(words(SizeRule::fixed(64, 32, 16)), "64 × 32 × 16");
    assert_eq!(words(wide(Extent::FramePixels(4.0))), "4 × the pixels of the frame × 1");
    assert_eq!(words(wide(Extent::Param("count".into()))), "the parameter `count` × 1");
}
