// What the two tables of light scattered onto surfaces share: which lobe they are for, and which texel this is.
#import scene
#import surface_table

struct Params {
    size: u32,
    lobe: u32,                  // 0 lambert, 1 phong
}

var<uniform> params: Params;
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

fn exponent_of_table() -> f32 {
    return select(1.0, shininess(), params.lobe == 1u);
}
