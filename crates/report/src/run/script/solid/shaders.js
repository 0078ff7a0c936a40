// What the graphics processor does for the model in three dimensions: parallel projection, flat shading, hidden lines by depth.

/** Points lie in rows of so many texels; the shaders say it as well. */
const ROW = 1024;

/** Where points are, what a mark looks like, and the way to the sheet: before every vertex shader. */
const SPACE = `#version 300 es
precision highp float;
precision highp int;
uniform highp sampler2D rest, moved, looks, values;
uniform float factor;            // 0: at rest
uniform vec3 right, up, eye;
uniform vec2 middle, scale, shift, deep, size;
uniform float pixel;             // so long is a pixel, m
uniform float bias;              // towards the eye, pixels
uniform int tint;                // 1 by the displacement of points, 2 by the value of marks, else none
uniform float most;
uniform vec3 over;               // instead of the colour of the mark
flat out vec4 look;
out float value;
out vec3 at;
out float along;
ivec2 cell(int i) { return ivec2(i & 1023, i >> 10); }
vec3 place(int i) { return texelFetch(rest, cell(i), 0).xyz + factor * texelFetch(moved, cell(i), 0).xyz; }
float sized(int i) { return length(texelFetch(moved, cell(i), 0).xyz) / most; }
vec3 sheet(vec3 p) { return vec3(dot(p, right), dot(p, up), dot(p, eye)); }
vec4 clip(vec3 s) { return vec4((s.xy - middle) * scale + shift, (deep.x - s.z - bias * pixel) * deep.y, 1.0); }
bool dressed(int mark, int point) {
  look = texelFetch(looks, cell(mark), 0);
  if (over.x >= 0.0) look.rgb = over;
  value = tint == 1 ? sized(point) : tint == 2 ? texelFetch(values, cell(mark), 0).x : -1.0;
  along = 0.0;
  at = vec3(0.0);
  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  return look.a > 0.0;
}
`;

/** Members by the outline of their section: a prism between two points. */
const MEMBER = `${SPACE}
layout(location = 0) in vec3 corner;
layout(location = 1) in int end;
layout(location = 2) in ivec2 ends;
layout(location = 3) in int mark;
void main() {
  int point = end == 0 ? ends.x : ends.y;
  if (!dressed(mark, point)) return;
  at = sheet(place(point) + corner);
  gl_Position = clip(at);
}`;

/** Lines so many pixels wide. */
const LINE = `${SPACE}
layout(location = 0) in vec2 corner;   // which end, which side
layout(location = 2) in ivec2 ends;
layout(location = 3) in int mark;
uniform float width;
void main() {
  int point = corner.x == 0.0 ? ends.x : ends.y;
  if (!dressed(mark, point)) return;
  vec4 a = clip(sheet(place(ends.x))), b = clip(sheet(place(ends.y)));
  vec2 way = (b.xy - a.xy) * size;
  float far = length(way);
  vec2 across = far > 0.0 ? vec2(-way.y, way.x) / far : vec2(0.0);
  gl_Position = corner.x == 0.0 ? a : b;
  gl_Position.xy += corner.y * width * across / size;
  along = 0.5 * far * corner.x;
}`;

/** Faces of bodies. */
const FACE = `${SPACE}
layout(location = 0) in int point;
layout(location = 3) in int mark;
void main() {
  if (!dressed(mark, point)) return;
  at = sheet(place(point));
  gl_Position = clip(at);
}`;

/** Symbols of links and supports: of one size on the screen, their own axis in space. */
const SYMBOL = `${SPACE}
layout(location = 0) in vec3 corner;
layout(location = 2) in ivec2 ends;
layout(location = 3) in int mark;
layout(location = 4) in vec3 axis;
uniform float large;             // pixels
void main() {
  if (!dressed(mark, ends.x)) return;
  vec3 other = abs(axis.z) < 0.9 ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0);
  vec3 second = normalize(cross(other, axis)), third = cross(axis, second);
  vec3 p = 0.5 * (place(ends.x) + place(ends.y));
  at = sheet(p + large * pixel * (corner.x * axis + corner.y * second + corner.z * third));
  gl_Position = clip(at);
}`;

/** Nodes as dots. */
const DOT = `${SPACE}
layout(location = 0) in int point;
layout(location = 3) in int mark;
uniform float large;
void main() {
  if (!dressed(mark, point)) return;
  gl_Position = clip(sheet(place(point)));
  gl_PointSize = large;
}`;

/** The ground: a rectangle that does not move. */
const GROUND = `${SPACE}
layout(location = 0) in vec2 corner;
uniform vec3 low, high;
void main() {
  look = vec4(over, 1.0);
  value = -1.0;
  along = 0.0;
  at = sheet(mix(low, high, vec3(corner, 0.0)));
  gl_Position = clip(at);
}`;

/** Colours: of the mark, or of its value; one light from the left above, the same on both sides of a face. */
const PAINT = `#version 300 es
precision highp float;
flat in vec4 look;
in float value;
in vec3 at;
in float along;
uniform vec3 palette[6];
uniform float shaded, dash;
out vec4 color;
void main() {
  if (dash > 0.0 && mod(along, 2.0 * dash) > dash) discard;
  vec3 base = look.rgb;
  if (value >= 0.0) {
    float x = clamp(value, 0.0, 1.0) * 5.0;
    int i = min(int(x), 4);
    base = mix(palette[i], palette[i + 1], x - float(i));
  }
  if (shaded > 0.0) {
    vec3 normal = normalize(cross(dFdx(at), dFdy(at)));
    base *= 0.52 + 0.5 * abs(dot(normal, vec3(-0.34, 0.82, 0.46)));
  }
  color = vec4(base, 1.0);
}`;
