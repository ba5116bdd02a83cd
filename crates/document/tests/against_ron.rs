//! Our reader and that of the `ron` crate must read the same from the same text.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, its helpers too")]

use std::collections::BTreeMap;
use std::sync::Arc;

use proptest::prelude::*;
use ron::value::Number as RonNumber;
use ron::{Options, Value as RonValue, extensions::Extensions};
use serde::Deserialize;
use tyndall_document::{Diagnostics, Node, Source, Value, parse, render_text};

fn ours(text: &str) -> Result<Node, String> {
    let source: Arc<Source> = Source::new("text.ron", text);
    let mut out = Diagnostics::new();
    let node = parse(&source, &mut out);
    if out.has_errors() { Err(render_text(&out, false)) } else { Ok(node.expect("no error, so a value")) }
}

fn theirs(text: &str) -> Result<RonValue, String> {
    ron::from_str(text).map_err(|error| error.to_string())
}

/// The two say the same. `ron::Value` has no names: a variant without content is a unit to it.
fn same(ours: &Node, theirs: &RonValue) -> bool {
    let all = |ours: &[Node], theirs: &[RonValue]| {
        ours.len() == theirs.len() && ours.iter().zip(theirs).all(|(ours, theirs)| same(ours, theirs))
    };
    match (&ours.value, theirs) {
        (_, RonValue::Option(Some(inner))) => same(ours, inner),
        (Value::Variant { name, content: None, .. }, RonValue::Option(None)) => name == "None",
        (Value::Variant { content: None, .. } | Value::Unit, RonValue::Unit) => true,
        (Value::Variant { content: Some(content), .. }, _) => same(content, theirs),
        (Value::Unit, RonValue::Seq(items)) => items.is_empty(),
        (Value::Bool(a), RonValue::Bool(b)) => a == b,
        (Value::Char(a), RonValue::Char(b)) => a == b,
        (Value::Text(a), RonValue::String(b)) => a == b,
        (Value::Number(a), RonValue::Number(b)) => {
            let integer = match *b {
                RonNumber::I8(b) => Some(b.into()),
                RonNumber::I16(b) => Some(b.into()),
                RonNumber::I32(b) => Some(b.into()),
                RonNumber::I64(b) => Some(b),
                RonNumber::U8(b) => Some(b.into()),
                RonNumber::U16(b) => Some(b.into()),
                RonNumber::U32(b) => Some(b.into()),
                RonNumber::U64(b) => i64::try_from(b).ok(),
                _ => None,
            };
            let value = b.into_f64();
            a.integer == integer && (a.value == value || a.value.is_nan() && value.is_nan())
        }
        (Value::List(a) | Value::Tuple(a), RonValue::Seq(b)) => all(a, b),
        (Value::Map(a), RonValue::Map(b)) => {
            a.len() == b.len() && a.iter().all(|(key, value)| b.iter().any(|(k, v)| same(key, k) && same(value, v)))
        }
        (Value::Struct(a), RonValue::Map(b)) => {
            a.len() == b.len()
                && a.iter().all(|field| {
                    b.iter().any(|(k, v)| *k == RonValue::String(field.name.clone()) && same(&field.value, v))
                })
        }
        _ => false,
    }
}

fn assert_agree(text: &str) {
    match (ours(text), theirs(text)) {
        (Ok(ours), Ok(theirs)) => assert!(same(&ours, &theirs), "{text:?}\n{ours:?}\n{theirs:?}"),
        (Err(_), Err(_)) => {}
        (ours, theirs) => panic!("{text:?}\nours: {ours:?}\ntheirs: {theirs:?}"),
    }
}

/// Accepted by both.
const ACCEPTED: &[&str] = &[
    "()",
    "true",
    "false",
    "None",
    "Some(1)",
    "Some ( 1 , )",
    "Some(Some(1))",
    "Some((a: 1))",
    "Name",
    "Name(1)",
    "Name(a: 1)",
    "Name (1, 2)",
    "Name()",
    "r#type",
    "r#a-b.c",
    "(r#a-b: 1)",
    "(r#type: 1)",
    "_x",
    "größe",
    "(größe: 1)",
    "[]",
    "[1]",
    "[1,]",
    "[[], [[]]]",
    "{}",
    "{1: 2}",
    "{\"a\": 1, 'b': (2), Some(3): [4],}",
    "(1)",
    "(1,)",
    "(1, 2)",
    "(a: 1)",
    "(a: 1,)",
    "( a : 1 )",
    "(a: (b: (c: ())))",
    "(a: 1, r#b: 2)",
    "(true, inf, NaN)",
    // Numbers.
    "0",
    "-0",
    "+5",
    "007",
    "1_000",
    "1_",
    "1__0",
    "255u8",
    "-128i8",
    "0u8",
    "-0u8",
    "1i64",
    "18446744073709551615",
    "9223372036854775807",
    "-9223372036854775808",
    "9223372036854775808",
    "18446744073709551616",
    "-9223372036854775809",
    "123456789012345678",
    "1234567890123456789",
    "99999999999999999999999999",
    "0x1f",
    "0xFFu8",
    "-0x10",
    "0x1f32",
    "0xf64",
    "0b1010",
    "0b1_0",
    "0o17",
    "0xffff_ffff",
    "1.5",
    "-1.5",
    "+1.5",
    ".5",
    "1.",
    "-.5",
    "1.5_0",
    "1_0.5",
    "1e5",
    "1E5",
    "1e+5",
    "1e-5",
    "1_e5",
    "1e_5",
    "1e-_5",
    "1.5e3",
    "1.e3",
    "1f32",
    "1f64",
    "1.5f32",
    "0.1f32",
    "0.1",
    "0.30000000000000004",
    "1e5f64",
    "1_f32",
    "1e400",
    "-1e400",
    "1e-400",
    "5e-324",
    "1.7976931348623157e308",
    "inf",
    "-inf",
    "+inf",
    "NaN",
    "-NaN",
    "inff32",
    "-inff64",
    "NaNf32",
    "+NaNf64",
    "1e-5f32",
    // Strings and characters.
    "\"\"",
    "\"a\"",
    "\"a\\nb\\t\\r\\0\\\\\\\"\\'\"",
    "\"\\x41\"",
    "\"\\xe2\\x82\\xac\"",
    "\"\\u{263a}\"",
    "\"\\u{41}\"",
    "\"\\u{10ffff}\"",
    "\"two\nlines\"",
    "\"a \\\n   b\"",
    "\"a \\\r\n \t\n  b\"",
    "\"\\\n\"",
    "\"é☃\u{1f600}\"",
    "r\"a\\b\"",
    "r#\"a\"b\"#",
    "r##\"a\"#b\"##",
    "r\"\"",
    "r#\"\"#",
    "'a'",
    "'\\n'",
    "'\\''",
    "'''",
    "'\"'",
    "'\\x41'",
    "'\\u{263a}'",
    "'☃'",
    "'\n'",
    "' '",
    "'\\\\'",
    // Space, comments, attributes.
    " \t\r\n1\u{b}\u{c}\u{85}\u{200e}\u{200f}\u{2028}\u{2029}",
    "// c\n1",
    "1 // c",
    "1//",
    "/* c */ 1",
    "/* a /* b */ c */ 1",
    "/**/1/**/",
    "[1/* , */, // ]\n 2]",
    "/*/**/*/1",
    "/***/1",
    "(a /* : */ : // x\n 1)",
    "Name /* c */ (1)",
    "#![enable(implicit_some)]\n1",
    "#![enable(implicit_some,)] 1",
    "# ! [ enable ( implicit_some ) ]\n(a: 1)",
    "#![type = \"a\"]\n1",
    "#![schema = \"a/b\"] #![enable(implicit_some)] 1",
];

/// Refused by both.
const REFUSED: &[&str] = &[
    "",
    " ",
    "// c",
    "/*",
    "/* /* */",
    "/",
    "1 /",
    "(",
    "[",
    "{",
    ")",
    "]",
    "}",
    "(]",
    "[}",
    "{)",
    "[1 2]",
    "[1;2]",
    "(1 2)",
    "(a: 1 b: 2)",
    "(a: 1, 2)",
    "(1, a: 2)",
    "{1}",
    "{1 2}",
    "{1: }",
    "{: 1}",
    "{1, 2}",
    "[,]",
    "[1,,]",
    "(,)",
    "(a:)",
    "(a: ,)",
    "(a = 1)",
    "(\"a\": 1)",
    "[1: 2]",
    "(a: b: 1)",
    "1 2",
    "() ()",
    "[1]]",
    "Some",
    "Some()",
    "Some(1, 2)",
    "Some(a: 1)",
    "Some 1",
    "None()",
    "true()",
    "Name[1]",
    "a.b",
    "a-b",
    "$a",
    "a$b",
    "(a-b: 1)",
    "r#",
    "(r#: 1)",
    "@",
    "%",
    "\\",
    "~",
    "=",
    ":",
    ",",
    ";",
    "1;",
    "\u{0}",
    "\u{1b}",
    "nul\u{0}l",
    "0x",
    "0b",
    "0o",
    "0x_1",
    "0xg",
    "0b2",
    "0b12",
    "0o8",
    "12abc",
    "1e",
    "1e+",
    "1.5.2",
    "--1",
    "+-1",
    "- 1",
    "+",
    "-",
    ".",
    "-.",
    "_1.5.",
    "1_.5.2",
    "._5",
    "-_1",
    "1._5",
    "300u8",
    "-1u8",
    "128i8",
    "99999999999999999999u64",
    "0x1ffffffffffffffff",
    "-0xffffffffffffffff",
    "1.5u8",
    "1e5i32",
    "1i128",
    "1u",
    "1i",
    "1f16",
    "1.0f",
    "0b1f32",
    "0o7f64",
    "0X1F",
    "0B1",
    "infinity(",
    "-infinity",
    "-nan",
    "1-2",
    "1+2",
    "[1+2]",
    "1é",
    "0x1.8",
    "1_u128",
    "\"",
    "\"a",
    "\"\\\"",
    "\"\\q\"",
    "\"\\x4\"",
    "\"\\xg0\"",
    "\"\\x80\"",
    "\"\\xe2\\x82\"",
    "\"\\u41\"",
    "\"\\u{}\"",
    "\"\\u{1234567}\"",
    "\"\\u{d800}\"",
    "\"\\u{110000}\"",
    "\"\\u{4g}\"",
    "\"\\u{41\"",
    "\"a\"b",
    "r\"a",
    "r#\"a\"",
    "r##\"a\"#",
    "r##a",
    "'",
    "''",
    "'a",
    "'ab'",
    "'\\q'",
    "'\\x80'",
    "'\\xe2\\x82\\xac'",
    "'\\\n'",
    "'\\u{41'",
    "#",
    "#!",
    "#![",
    "#![]",
    "#![allow(x)] 1",
    "#![enable(nonsense)] 1",
    "#![enable(implicit_some) 1",
    "#![enable] 1",
    "#![type = a] 1",
    "1 #![enable(implicit_some)]",
];

#[test]
fn both_accept() {
    for text in ACCEPTED {
        assert!(theirs(text).is_ok(), "ron refuses {text:?}: {:?}", theirs(text));
        assert_agree(text);
    }
}

#[test]
fn both_refuse() {
    for text in REFUSED {
        assert!(theirs(text).is_err(), "ron accepts {text:?}: {:?}", theirs(text));
        assert!(ours(text).is_err(), "ours accepts {text:?}: {:?}", ours(text));
    }
}

/// What `ron` accepts and we refuse, each with its reason.
#[test]
fn we_refuse_more() {
    for (text, code) in [
        // A key that appears twice is a mistake, never a choice.
        ("{\"a\": 1, \"a\": 2}", "duplicate-name"),
        ("(a: 1, a: 2)", "duplicate-name"),
        // Nothing in our files holds bytes or ranges.
        ("b\"ab\"", "unsupported-syntax"),
        ("br#\"ab\"#", "unsupported-syntax"),
        ("b'a'", "unsupported-syntax"),
        ("0..10", "unsupported-syntax"),
        ("1..", "unsupported-syntax"),
        ("..=3", "unsupported-syntax"),
        ("1..5.2", "unsupported-syntax"),
        // These change what parentheses mean, which a file must not.
        ("#![enable(unwrap_newtypes)] 1", "unsupported-syntax"),
        ("#![enable(unwrap_variant_newtypes)] 1", "unsupported-syntax"),
        ("#![enable(explicit_struct_names)] 1", "unsupported-syntax"),
    ] {
        assert!(theirs(text).is_ok(), "ron refuses {text:?}: {:?}", theirs(text));
        let refusal = ours(text).expect_err(text);
        assert!(refusal.starts_with(&format!("error[{code}]")), "{text:?}\n{refusal}");
    }
}

/// What we accept and `ron` refuses: a byte order mark, which some editors write.
#[test]
fn we_accept_more() {
    assert!(theirs("\u{feff}1").is_err());
    assert!(ours("\u{feff}1").is_ok());
}

/// NaN is a number to both readers; our decoder refuses it later, with a place.
#[test]
fn nan_is_read() {
    assert!(same(&ours("NaN").unwrap(), &theirs("NaN").unwrap()));
}

#[test]
fn depth_has_an_end() {
    for (open, close) in [("[", "]"), ("(", ")"), ("A(", ")"), ("Some(", ")"), ("(a: ", ")"), ("{1: ", "}")] {
        // Where ron reads into its own `Value`, it counts every bracket but that of `Some` twice.
        for (depth, accepted, by_ron) in
            [(64, true, true), (128, true, open == "Some("), (129, false, false), (100_000, false, false)]
        {
            let text = format!("{}1{}", open.repeat(depth), close.repeat(depth));
            assert_eq!(ours(&text).is_ok(), accepted, "{depth} times {open}");
            assert_eq!(theirs(&text).is_ok(), by_ron, "{depth} times {open}");
            // Nor do unclosed ones overflow the stack.
            assert!(ours(&open.repeat(depth)).is_err());
        }
    }
}

#[derive(Debug, PartialEq, Deserialize)]
enum Shape {
    Point,
    Wrapped(f64),
    Pair(f64, String),
    Named { a: i64, b: Option<bool> },
}

/// The same text through `serde` with implicit `Some`, for what `ron::Value` does not keep: names.
#[test]
fn variants_keep_their_names() {
    let options = Options::default().with_default_extension(Extensions::IMPLICIT_SOME);
    let text = r#"[Point, Wrapped(1), Pair(2.5, "x"), Named(a: 3, b: true), Named(b: Some(false), a: 4), Named(a: 5, b: None)]"#;
    let theirs: Vec<Shape> = options.from_str(text).unwrap();
    let Value::List(items) = ours(text).unwrap().value else { panic!() };
    let ours: Vec<Shape> = items.iter().map(shape).collect();
    assert_eq!(ours, theirs);
}

fn shape(node: &Node) -> Shape {
    let Value::Variant { name, content, .. } = &node.value else { panic!("{node:?}") };
    let number = |node: &Node| match node.value {
        Value::Number(number) => number.value,
        _ => panic!("{node:?}"),
    };
    match (name.as_str(), content.as_ref().map(|content| &content.value)) {
        ("Point", None) => Shape::Point,
        ("Wrapped", Some(Value::Tuple(items))) => Shape::Wrapped(number(&items[0])),
        ("Pair", Some(Value::Tuple(items))) => match &items[1].value {
            Value::Text(text) => Shape::Pair(number(&items[0]), text.clone()),
            _ => panic!(),
        },
        ("Named", Some(Value::Struct(fields))) => {
            let field = |name: &str| &fields.iter().find(|field| field.name == name).unwrap().value;
            let b = match &field("b").value {
                Value::Bool(value) => Some(*value),
                _ => None,
            };
            Shape::Named { a: number(field("a")) as i64, b }
        }
        other => panic!("{other:?}"),
    }
}

/// What `ron` prints of random values.
#[derive(Debug, Clone, serde::Serialize)]
enum Any {
    Unit,
    Flag(bool),
    Integer(i64),
    Large(u64),
    Double(f64),
    Single(f32),
    Text(String),
    Letter(char),
    Maybe(Option<Box<Any>>),
    List(Vec<Any>),
    Map(BTreeMap<String, Any>),
    Numbered(BTreeMap<i32, Any>),
    Pair(Box<Any>, Box<Any>),
    Named { first: Box<Any>, r#type: Box<Any>, none: Option<u8> },
}

fn any_value() -> impl Strategy<Value = Any> {
    let leaf = prop_oneof![
        Just(Any::Unit),
        any::<bool>().prop_map(Any::Flag),
        any::<i64>().prop_map(Any::Integer),
        any::<u64>().prop_map(Any::Large),
        any::<f64>().prop_map(Any::Double),
        prop::num::f64::ANY.prop_map(Any::Double),
        any::<f32>().prop_map(Any::Single),
        any::<String>().prop_map(Any::Text),
        "[a-z\"\\\\#\n/*]{0,8}".prop_map(Any::Text),
        any::<char>().prop_map(Any::Letter),
    ];
    leaf.prop_recursive(5, 48, 6, |inner| {
        let boxed = || inner.clone().prop_map(Box::new);
        prop_oneof![
            prop::option::of(boxed()).prop_map(Any::Maybe),
            prop::collection::vec(inner.clone(), 0..6).prop_map(Any::List),
            prop::collection::btree_map(".{0,6}", inner.clone(), 0..20).prop_map(Any::Map),
            prop::collection::btree_map(any::<i32>(), inner.clone(), 0..6).prop_map(Any::Numbered),
            (boxed(), boxed()).prop_map(|(a, b)| Any::Pair(a, b)),
            (boxed(), boxed()).prop_map(|(first, r#type)| Any::Named { first, r#type, none: None }),
        ]
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1500, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn what_ron_prints_both_read_alike(value in any_value()) {
        let pretty = ron::ser::PrettyConfig::new().struct_names(true).compact_arrays(true);
        let texts = [
            ron::ser::to_string(&value).unwrap(),
            ron::ser::to_string_pretty(&value, ron::ser::PrettyConfig::default()).unwrap(),
            ron::ser::to_string_pretty(&value, pretty).unwrap(),
        ];
        for text in texts {
            let theirs = theirs(&text).unwrap();
            match ours(&text) {
                Ok(ours) => prop_assert!(same(&ours, &theirs), "{}\n{:?}\n{:?}", text, ours, theirs),
                Err(error) => prop_assert!(false, "{}\n{}", text, error),
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 20_000, failure_persistence: None, ..ProptestConfig::default() })]

    /// Random tokens: most are refused by both, some accepted by both.
    #[test]
    fn both_agree_on_random_tokens(tokens in prop::collection::vec(token(), 1..10)) {
        let text = tokens.concat();
        let mentions_what_we_refuse = text.contains("..") || text.contains("b'") || text.contains("b\"") || text.contains("br");
        if let (Err(error), Ok(value)) = (ours(&text), theirs(&text)) {
            let refused = mentions_what_we_refuse || error.starts_with("error[duplicate-name]");
            prop_assert!(refused, "{}\n{:?}\n{}", text, value, error);
        }
        if let Ok(ours) = ours(&text) {
            match theirs(&text) {
                Ok(theirs) => prop_assert!(same(&ours, &theirs), "{}\n{:?}\n{:?}", text, ours, theirs),
                Err(error) => prop_assert!(false, "{}\n{:?}\n{}", text, ours, error),
            }
        }
    }

    /// Random numbers, most of them wrong.
    #[test]
    fn both_agree_on_random_numbers(text in "[+-]?(0x|0b|0o)?[0-9a-f_]{0,6}[.]?[0-9_]{0,4}(e[+-]?[0-9_]{0,3})?(u8|i16|u64|f32|f64)?") {
        prop_assume!(!text.is_empty() && !text.contains("..") );
        match (ours(&text), theirs(&text)) {
            (Ok(ours), Ok(theirs)) => prop_assert!(same(&ours, &theirs), "{}\n{:?}\n{:?}", text, ours, theirs),
            (Err(_), Err(_)) => {}
            (ours, theirs) => prop_assert!(false, "{}\n{:?}\n{:?}", text, ours, theirs),
        }
    }
}

fn token() -> impl Strategy<Value = &'static str> {
    prop::sample::select(vec![
        "(", ")", "[", "]", "{", "}", ",", ":", " ", "\n", "a", "a: ", "Name", "Some(", "None", "true", "1", "-2",
        "1.5", "0x1f", "\"s\"", "'c'", "// c\n", "/* c */", "r#\"x\"#", "r#b", ", ", "()", "\"k\": ", "[1, 2]",
        "(x: 1)", "_", "e5", "u8",
    ])
}
