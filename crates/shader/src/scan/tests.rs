use super::*;

fn scanned(text: &str) -> Scan {
    scan(&Source::new("test.wgsl", text))
}

fn messages(text: &str) -> Vec<String> {
    scanned(text).problems.into_iter().map(|problem| problem.message).collect()
}

#[test]
fn imports_outside_comments_are_found() {
    let text = "#import phase\n// #import no\n/* #import no /* #import no */ */\n  #import \"a.wgsl\" // yes\n";
    let found = scanned(text);
    let targets: Vec<_> = found.imports.iter().map(|import| &import.target).collect();
    assert_eq!(targets, [&Target::Module("phase".into()), &Target::File("a.wgsl".into())]);
    let Import { span, name_span, .. } = &found.imports[1];
    assert_eq!(&text[span.start as usize..span.end as usize], "#import \"a.wgsl\"");
    assert_eq!(&text[name_span.start as usize..name_span.end as usize], "\"a.wgsl\"");
    assert!(found.problems.is_empty());
}

#[test]
fn malformed_directives_are_reported() {
    assert_eq!(messages("#define A 1\n"), ["`#define` is not known"]);
    assert_eq!(messages("#import\n"), ["`#import` needs a module's name or a quoted file"]);
    assert_eq!(messages("#import \"\"\n"), ["`#import` needs a module's name or a quoted file"]);
    assert_eq!(messages("#import a b\n"), ["`b` follows the import"]);
    assert_eq!(messages("const a = 1; #import a\n"), ["`#import` must stand on a line of its own"]);
    for text in ["#require\n", "#require f\n", "#require fn f\n", "#require struct A { x: f32 }\n", "#require fn (\n"] {
        assert_eq!(messages(text), ["`#require` needs the head of a declaration"], "{text}");
    }
}

#[test]
fn requirements_are_found() {
    let text = "#require struct A // so\n#import a\n #require fn f(a: A) -> f32\n// #require fn g()\n";
    let found = scanned(text);
    let declarations: Vec<_> = found.requirements.iter().map(|r| (r.name.as_str(), r.declaration.as_str())).collect();
    assert_eq!(declarations, [("A", "struct A"), ("f", "fn f(a: A) -> f32")]);
    let spans: Vec<_> = found.directives().iter().map(|span| &text[span.start as usize..span.end as usize]).collect();
    assert_eq!(spans, ["#require struct A", "#import a", "#require fn f(a: A) -> f32"]);
    assert!(found.problems.is_empty() && found.declared.is_empty());
}

#[test]
fn declared_names_are_found() {
    let found = scanned("var<storage, read_write> a: array<u32>;\nfn f(x: f32) { var y = 1; }\noverride n: u32 = 3;\n");
    let names: Vec<_> = found.declared.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["a", "f", "n"]);
}

#[test]
fn brackets_and_comments_must_close() {
    assert_eq!(messages("fn f() { if (a { }\n"), ["`(` is not closed"]);
    assert_eq!(messages("fn f() { ) }"), ["`)` does not close `{`"]);
    assert_eq!(messages("}"), ["`}` has no opening bracket"]);
    assert_eq!(messages("/* /* */"), ["this comment is never closed"]);
}

#[test]
fn written_bindings_are_refused_once_each() {
    let found = scanned(
        "@group(0) @binding(1) var a: sampler;\n@id(3) override b: u32;\n@binding(2) @group(1) var c: sampler;",
    );
    let texts: Vec<_> = found.problems.iter().map(|problem| problem.message.split('`').nth(1).unwrap()).collect();
    assert_eq!(texts, ["@group(0) @binding(1)", "@id(3)", "@binding(2) @group(1)"]);
}

#[test]
fn deep_expressions_are_refused_and_long_tables_are_not() {
    let deep = ["the operators of this expression are nested more than 1000 deep"];
    assert_eq!(messages(&format!("const a = {} 1;", "!".repeat(1_001))), deep);
    assert_eq!(messages(&format!("const a = {} 1;", "f(1, 2) + ".repeat(600))), deep);
    assert_eq!(messages(&format!("const a = {}1{};", "(1 + ".repeat(600), ")".repeat(600))), deep);
    assert_eq!(messages(&format!("const a = x{};", "[0]".repeat(1_001))), deep);
    assert!(messages(&format!("const a = array({});", "vec2(-1.0, 2.0), ".repeat(9_000))).is_empty());
    assert!(messages(&"const a = 1 + 2; fn f() { let x = 1.0 * 3.0; }\n".repeat(900)).is_empty());
}
