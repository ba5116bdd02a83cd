// Which lobe a table of light scattered onto surfaces is for.
#import scene

var<storage, read> materials: Materials;

// The shininess of the first material that has a Phong lobe; 1 where none has.
fn shininess() -> f32 {
    var found = 0.0;
    // a list without materials holds a zeroed one
    var i = 0u;
    loop {
        let material = materials.items[i];
        let shiny = any(material.specular > vec3<f32>(0.0));
        found = select(found, material.shininess, shiny && found == 0.0);
        i++;
        if i >= materials.count { break; }
    }
    return select(1.0, found, found > 0.0);
}

// `lobe`: 0 Lambert, 1 Phong.
fn exponent_of_table(lobe: u32) -> f32 {
    return select(1.0, shininess(), lobe == 1u);
}
