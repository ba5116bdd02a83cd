// A sum over the nodes of a Gauss-Legendre rule.

#import quadrature

#require struct Integrand
#require fn at_node(integrand: Integrand, node: vec2<f32>) -> vec3<f32>

// `nodes`, 2 to 16, is a constant of the pipeline, so what stands here is a plain sum.
fn sum_over_nodes(integrand: Integrand, nodes: u32) -> vec3<f32> {
    var sum = at_node(integrand, gauss_legendre(nodes, 0u)) + at_node(integrand, gauss_legendre(nodes, 1u));
    if nodes > 2u { sum += at_node(integrand, gauss_legendre(nodes, 2u)); }
    if nodes > 3u { sum += at_node(integrand, gauss_legendre(nodes, 3u)); }
    if nodes > 4u { sum += at_node(integrand, gauss_legendre(nodes, 4u)); }
    if nodes > 5u { sum += at_node(integrand, gauss_legendre(nodes, 5u)); }
    if nodes > 6u { sum += at_node(integrand, gauss_legendre(nodes, 6u)); }
    if nodes > 7u { sum += at_node(integrand, gauss_legendre(nodes, 7u)); }
    if nodes > 8u { sum += at_node(integrand, gauss_legendre(nodes, 8u)); }
    if nodes > 9u { sum += at_node(integrand, gauss_legendre(nodes, 9u)); }
    if nodes > 10u { sum += at_node(integrand, gauss_legendre(nodes, 10u)); }
    if nodes > 11u { sum += at_node(integrand, gauss_legendre(nodes, 11u)); }
    if nodes > 12u { sum += at_node(integrand, gauss_legendre(nodes, 12u)); }
    if nodes > 13u { sum += at_node(integrand, gauss_legendre(nodes, 13u)); }
    if nodes > 14u { sum += at_node(integrand, gauss_legendre(nodes, 14u)); }
    if nodes > 15u { sum += at_node(integrand, gauss_legendre(nodes, 15u)); }
    return sum;
}
