// Light of the medium that comes from no light of the scene, on surfaces: J, the constant radiance of what is scattered many
// times and of emission (see Ambient), comes from all around through a medium without end, which is opaque wherever there is
// extinction.
//
//   reflected = J (rho + k_s 2 pi/(n + 1))
// (Biri, Arques and Michelin 2006, eq. 2, adds L_a e^(-k_t d) for each light to what a surface sends, as it is: that fades with
// the fog, grows with the number of lights, and a black surface shines.)
#import scene
#import cone
#import medium

var<uniform> ambient: Ambient;

fn ambient_reflected(medium: Medium, diffuse: vec3<f32>, specular: vec3<f32>, shininess: f32) -> vec3<f32> {
    let around = select(vec3<f32>(0.0), ambient.radiance, medium.extinction > vec3<f32>(0.0));
    return around * (diffuse + specular * (2.0 * PI / (shininess + 1.0)));
}
