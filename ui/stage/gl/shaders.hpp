// SPDX-License-Identifier: GPL-3.0-or-later
/// The stage's shaders.
#pragma once

namespace extremal::shaders {

/// A stroke from a to b with round ends becomes a quad that holds it and half a pixel of soft edge.
/// `local` is the fragment's place in pixels along and across the stroke, from a.
inline constexpr const char* strokeVertex = R"(#version 330 core
layout(location = 0) in vec3 a;
layout(location = 1) in vec3 b;
layout(location = 2) in float halfWidth;
layout(location = 3) in vec3 colour;
layout(location = 4) in vec2 alpha;
uniform mat4 view;
uniform vec2 halfSize;
out vec2 local;
flat out float span;
flat out float halfWide;
flat out vec3 tint;
flat out vec2 alphas;
void main() {
    vec4 ca = view * vec4(a, 1.0), cb = view * vec4(b, 1.0);
    vec2 pa = ca.xy / ca.w * halfSize, pb = cb.xy / cb.w * halfSize;
    span = length(pb - pa);
    vec2 along = span > 1e-4 ? (pb - pa) / span : vec2(1.0, 0.0);
    vec2 across = vec2(-along.y, along.x);
    float reach = halfWidth + 1.0;
    bool atEnd = (gl_VertexID & 1) == 1;
    float side = (gl_VertexID & 2) == 2 ? reach : -reach;
    local = vec2(atEnd ? span + reach : -reach, side);
    vec2 pixel = pa + along * local.x + across * local.y;
    halfWide = halfWidth;
    tint = colour;
    alphas = alpha;
    gl_Position = vec4(pixel / halfSize, (atEnd ? cb.z / cb.w : ca.z / ca.w), 1.0);
}
)";

inline constexpr const char* strokeFragment = R"(#version 330 core
in vec2 local;
flat in float span;
flat in float halfWide;
flat in vec3 tint;
flat in vec2 alphas;
out vec4 result;
void main() {
    float x = clamp(local.x, 0.0, span);
    float away = length(local - vec2(x, 0.0));
    // A stroke thinner than a pixel keeps its width as strength.
    float coverage = clamp(halfWide + 0.5 - away, 0.0, 1.0) * min(1.0, 2.0 * halfWide);
    float strength = coverage * (span > 1e-4 ? mix(alphas.x, alphas.y, x / span) : alphas.x);
    result = vec4(tint * strength, strength);
}
)";

/// Flat triangles.
inline constexpr const char* fillVertex = R"(#version 330 core
layout(location = 0) in vec3 place;
layout(location = 1) in vec3 colour;
layout(location = 2) in float alpha;
uniform mat4 view;
out vec4 tint;
void main() {
    tint = vec4(colour * alpha, alpha);
    gl_Position = view * vec4(place, 1.0);
}
)";

inline constexpr const char* fillFragment = R"(#version 330 core
in vec4 tint;
out vec4 result;
void main() {
    result = tint;
}
)";

/// One triangle that covers the picture.
inline constexpr const char* layerVertex = R"(#version 330 core
void main() {
    vec2 corner = vec2((gl_VertexID & 1) * 4 - 1, (gl_VertexID & 2) * 2 - 1);
    gl_Position = vec4(corner, 0.0, 1.0);
}
)";

inline constexpr const char* layerFragment = R"(#version 330 core
uniform sampler2D layer;
uniform float opacity;
out vec4 result;
void main() {
    result = texelFetch(layer, ivec2(gl_FragCoord.xy), 0) * opacity;
}
)";

}  // namespace extremal::shaders
