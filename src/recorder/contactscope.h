/* contactscope.h: records the contacts of a physics engine as a trace for contactscope.
 * C99 or C++11, standard library only; needs IEEE doubles (x86, ARM and most others).
 *
 * In one source file of the engine:
 *
 *     #define CONTACTSCOPE_IMPLEMENTATION
 *     #include "contactscope.h"
 *
 * Around its step:
 *
 *     cs_recorder* r = cs_start("run.jsonl", "mine/stack", "my engine", "1.0", NULL);
 *     int floor = cs_plane(r, "floor", up, 0.0), crate = cs_box(r, "crate", 0.5, 0.5, 0.5);
 *     while (running) {
 *       cs_begin_frame(r, time);
 *       cs_pose(r, crate, position, quaternion_wxyz);           // every shape in this frame
 *       cs_manifold(r, floor, crate, normal, -1, points, count);  // every pair in contact
 *       cs_end_frame(r);
 *     }
 *     cs_stop(r);
 *
 * `contactscope render run.jsonl` draws the trace, `contactscope doctor run.jsonl` checks it.
 *
 * Conventions: metres, world space. Quaternions are unit, in the order w, x, y, z. Normals are unit
 * and point from a to b. A negative separation is an overlap. Impulses are newton seconds and act
 * on b, unless the settings say otherwise.
 *
 * Every function accepts a NULL recorder and then does nothing. cs_pose, cs_manifold and cs_body
 * are thread-safe; the file does not depend on the order of their calls. Each frame is written when
 * it ends, so a crash loses no earlier frame. When memory or disk runs out, recording stops, the
 * frames so far remain, and cs_failure() returns the reason.
 *
 * MIT License
 *
 * Copyright (c) 2026 The contactscope authors
 *
 * Permission is hereby granted, free of charge, to any person obtaining a copy of this software and associated
 * documentation files (the "Software"), to deal in the Software without restriction, including without limitation
 * the rights to use, copy, modify, merge, publish, distribute, sublicense, and/or sell copies of the Software, and
 * to permit persons to whom the Software is furnished to do so, subject to the following conditions:
 *
 * The above copyright notice and this permission notice shall be included in all copies or substantial portions of
 * the Software.
 *
 * THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR IMPLIED, INCLUDING BUT NOT LIMITED TO
 * THE WARRANTIES OF MERCHANTABILITY, FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE
 * AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER LIABILITY, WHETHER IN AN ACTION OF
 * CONTRACT, TORT OR OTHERWISE, ARISING FROM, OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS
 * IN THE SOFTWARE. */
#ifndef CONTACTSCOPE_RECORDER_H
#define CONTACTSCOPE_RECORDER_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct cs_recorder cs_recorder;

typedef struct cs_settings {
  int doubles;  /* 1: the engine computes in double, write 17 digits; 0: in float, write 9 */
  int z_up;     /* 1: z points up; 0: y points up */
  int poses_at; /* time of the poses: 0 same as the contacts, 1 before their step, 2 after it */
  double force_step; /* above 0: impulses are forces in newtons, over a step of this many seconds */
  int friction_on_a; /* 1: friction acts on a, not on b */
} cs_settings;

/* Zero it first: cs_point p = {0}; or memset. */
typedef struct cs_point {
  double position[3];
  double separation;
  int has_sides; /* 1: on_a and on_b are set: the points on the two surfaces */
  double on_a[3], on_b[3];
  int has_impulse;    /* 1: impulse and friction are set: the solver's, over the step */
  double impulse;     /* along the normal */
  double friction[3]; /* a vector perpendicular to the normal */
  int has_id;
  uint64_t id; /* identifies the point across frames */
  int idle;    /* 1: a speculative point that the solver did not act on */
} cs_point;

/* Creates the file; NULL on failure. `scenario` is GROUP/IDEA, the folder of its pictures. */
cs_recorder* cs_start(const char* path, const char* scenario, const char* engine,
                      const char* version, const cs_settings* settings);
void cs_stop(cs_recorder* r);
/* Reason for which recording stopped; NULL while there is none. */
const char* cs_failure(const cs_recorder* r);

/* Shapes, in local coordinates. Add them at any time. Returns the id of the shape, -1 on failure.
 * Duplicate names get a numeric suffix; NULL generates a name. */
int cs_box(cs_recorder* r, const char* name, double half_x, double half_y, double half_z);
int cs_sphere(cs_recorder* r, const char* name, double radius);
int cs_capsule(cs_recorder* r, const char* name, const double from[3], const double to[3],
               double radius);
/* Three doubles per vertex. Readers compute the faces of the convex hull. */
int cs_hull(cs_recorder* r, const char* name, const double* vertices, int vertex_count);
/* Centred on the origin, along axis 0, 1 or 2 (x, y, z); a cone's tip is at +half_length. Written
 * as 64-sided hulls with corners on the round surface; the error is up to 0.12 % of the radius. */
int cs_cylinder(cs_recorder* r, const char* name, int axis, double half_length, double radius);
int cs_cone(cs_recorder* r, const char* name, int axis, double half_length, double radius);
/* Three indices per triangle, counter-clockwise seen from outside. */
int cs_mesh(cs_recorder* r, const char* name, const double* vertices, int vertex_count,
            const int* triangles, int triangle_count);
/* Solid where normal . x <= offset. */
int cs_plane(cs_recorder* r, const char* name, const double normal[3], double offset);
/* columns x rows heights, row by row; the first is at the origin, neighbours are `spacing` metres
 * from each other. Columns run along +x, rows along -z if y is up and along +y if z is up. */
int cs_height_field(cs_recorder* r, const char* name, const double* heights, int columns, int rows,
                    double spacing);
/* For engines that add a margin to convex shapes: moves the surface of a hull, cylinder or cone
 * outwards by `margin` and rounds its edges. Call it before the first frame with the shape. */
void cs_margin(cs_recorder* r, int shape, double margin);
/* A body made of shapes at fixed poses. Call cs_pose for the compound, not for its parts. */
int cs_compound(cs_recorder* r, const char* name);
void cs_part(cs_recorder* r, int compound, int shape, const double position[3],
             const double quat_wxyz[4]);

/* Prints to stderr what is not recorded, and why. Repeated texts are printed once. */
void cs_note(cs_recorder* r, const char* text);

void cs_begin_frame(cs_recorder* r, double time);
/* A shape without a pose is absent from this frame. */
void cs_pose(cs_recorder* r, int shape, const double position[3], const double quat_wxyz[4]);
/* `triangle`: its index in the mesh, or -1. A pair may have several manifolds. If b was created
 * before a, the pair is written swapped, with its normal, friction and sides. */
void cs_manifold(cs_recorder* r, int a, int b, const double normal[3], int triangle,
                 const cs_point* points, int count);
void cs_body(cs_recorder* r, int shape, double mass, const double center_of_mass[3],
             const double velocity[3], const double angular_velocity[3]);
/* Solver settings of this step, for frames with cs_body; 0 for those the engine does not have. */
void cs_solver(cs_recorder* r, int iterations, int substeps, int warm_start);
void cs_end_frame(cs_recorder* r);

#ifdef __cplusplus
}
#endif

#endif /* CONTACTSCOPE_RECORDER_H */

#if defined(CONTACTSCOPE_IMPLEMENTATION) && !defined(CONTACTSCOPE_IMPLEMENTED)
#define CONTACTSCOPE_IMPLEMENTED

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if defined(_MSC_VER)
#include <intrin.h>
#define CS__TAKE(lock) _InterlockedExchange(&(lock), 1)
#define CS__GIVE(lock) _InterlockedExchange(&(lock), 0)
#else
#define CS__TAKE(lock) __sync_lock_test_and_set(&(lock), 1)
#define CS__GIVE(lock) __sync_lock_release(&(lock))
#endif

typedef struct cs__text {
  char* data;
  size_t size, room;
} cs__text;

typedef struct cs__pose {
  double position[3], rotation[4];
} cs__pose;

typedef struct cs__shape {
  char* name;   /* as JSON, with quotes */
  char* json;   /* its entry in the trace; NULL for compounds, and once written */
  int compound; /* that it is part of, or -1 */
  cs__pose in_compound, pose;
  int posed_in; /* last frame with its pose, or -1 */
  int is_compound;
  double margin; /* distance from the shape in `json` out to the surface */
} cs__shape;

typedef struct cs__manifold {
  int a, b, triangle, count;
  size_t first; /* index of its first point */
  double normal[3], place[3];
} cs__manifold;

typedef struct cs__body {
  int shape;
  double mass, numbers[3][3];
} cs__body;

struct cs_recorder {
  FILE* file;
  cs_settings settings;
  const char* failure;
  volatile long lock;
  cs__text line, head; /* the current frame; the header up to the shapes */
  cs__text notes;      /* printed so far, each between two line feeds */
  int frame, in_frame, has_header, has_solver, solver[3];
  double time;
  cs__shape* shapes;
  cs__manifold* manifolds;
  cs_point* points;
  cs__body* bodies;
  size_t shape_count, manifold_count, point_count, body_count;
  size_t shape_room, manifold_room, point_room, body_room;
};

static void cs__enter(cs_recorder* r) {
  while (CS__TAKE(r->lock)) {
    while (r->lock) {
    }
  }
}
static void cs__leave(cs_recorder* r) {
  CS__GIVE(r->lock);
}

/* Reserves room for `more` elements. Returns 0 if out of memory or after an earlier failure. */
static int cs__grow(cs_recorder* r, void** data, size_t* room, size_t count, size_t more,
                    size_t size) {
  void* larger;
  size_t wanted = *room ? *room : 64;
  if (r->failure) return 0;
  if (count + more <= *room) return 1;
  while (wanted < count + more) wanted *= 2;
  larger = realloc(*data, wanted * size);
  if (!larger) {
    r->failure = "out of memory";
    return 0;
  }
  *data = larger;
  *room = wanted;
  return 1;
}
#define CS__GROW(r, list, one, more) \
  cs__grow(r, (void**)&(r)->list, &(r)->one##_room, (r)->one##_count, more, sizeof *(r)->list)

static void cs__put(cs_recorder* r, cs__text* text, const char* what) {
  const size_t size = strlen(what);
  if (!cs__grow(r, (void**)&text->data, &text->room, text->size, size + 1, 1)) return;
  memcpy(text->data + text->size, what, size + 1);
  text->size += size;
}

static void cs__int(cs_recorder* r, cs__text* text, int value) {
  char digits[16];
  sprintf(digits, "%d", value);
  cs__put(r, text, digits);
}

/* Writes `value` with `count` decimal digits, correctly rounded. A double is m 2^e; the product
 * m 5^k (117 bits), shifted, is the value times 10^k. Needs no division, about ten times as fast as
 * printf. Returns the number of characters, or 0 if the value is out of range. */
static int cs__digits(double value, int count, char* out) {
  static const double kTens[] = {1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1,
                                 1e0,   1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9};
  /* clang-format off */
  static const uint64_t kFives[] = {
      1, 5, 25, 125, 625, 3125, 15625, 78125, 390625, 1953125, 9765625, 48828125, 244140625,
      1220703125, 6103515625ull, 30517578125ull, 152587890625ull, 762939453125ull,
      3814697265625ull, 19073486328125ull, 95367431640625ull, 476837158203125ull,
      2384185791015625ull, 11920928955078125ull, 59604644775390625ull, 298023223876953125ull,
      1490116119384765625ull, 7450580596923828125ull};
  /* clang-format on */
  uint64_t bits, five, mantissa, low, high, middle, whole;
  uint32_t part;
  int exponent, before, k, shift, i, length = 0;
  char digits[24], *begin = out;
  if (!(value >= 1e-10 && value < 1e9)) return 0;
  memcpy(&bits, &value, sizeof bits);
  exponent = (int)(bits >> 52) - 1022; /* value < 2^exponent; the range excludes subnormals */
  mantissa = (bits & 0xfffffffffffffull) | 0x10000000000000ull;
  /* Digits before the point; 0 or less: zeros after it. The estimate from log2 is at most 1 low. */
  before = (int)((exponent - 1) * 1233 >> 12) + 1;
  if (before < 9 && value >= kTens[before + 10]) ++before;
  k = count - before;
  five = kFives[k];
  low = (mantissa & 0xffffffffu) * (five & 0xffffffffu);
  middle = (mantissa >> 32) * (five & 0xffffffffu) + (low >> 32);
  high = (mantissa & 0xffffffffu) * (five >> 32) + (middle & 0xffffffffu);
  low = (low & 0xffffffffu) | high << 32;
  high = (mantissa >> 32) * (five >> 32) + (middle >> 32) + (high >> 32);
  shift = 53 - exponent - k;
  if (shift < 1 || shift > 127) return 0;
  if (shift < 64) {
    const uint64_t half = (uint64_t)1 << (shift - 1);
    low += half;
    high += low < half;
    whole = low >> shift | high << (64 - shift);
  } else {
    if (shift > 64)
      high += (uint64_t)1 << (shift - 65);
    else if (low >> 63)
      high += 1;
    whole = shift > 64 ? high >> (shift - 64) : high;
  }
  /* Least significant digit first, in parts of 9 digits: 32-bit division is faster. */
  for (part = (uint32_t)(whole % 1000000000u), i = 0; i < 9 && (part || whole >= 1000000000u);
       ++i) {
    digits[length++] = (char)('0' + part % 10);
    part /= 10;
  }
  for (part = (uint32_t)(whole / 1000000000u); part; part /= 10)
    digits[length++] = (char)('0' + part % 10);
  if (length > count) ++before; /* rounding reached the next power of ten */
  i = 0;
  while (i < length - 1 && digits[i] == '0') ++i; /* drop trailing zeros of the fraction */
  if (i > length - before) i = length - before > 0 ? length - before : 0;
  if (before <= 0) {
    *out++ = '0';
    *out++ = '.';
    for (k = before; k < 0; ++k) *out++ = '0';
  }
  for (k = length - 1; k >= i; --k) {
    if (before > 0 && length - 1 - k == before) *out++ = '.';
    *out++ = digits[k];
  }
  *out = 0;
  return (int)(out - begin);
}

static void cs__number(cs_recorder* r, cs__text* text, double value) {
  const int count = r->settings.doubles ? 17 : 9;
  const double size = value < 0 ? -value : value;
  char* out;
  int length = 0;
  if (!cs__grow(r, (void**)&text->data, &text->room, text->size, 48, 1)) return;
  out = text->data + text->size;
  if (!(value - value == 0)) {
    length = sprintf(out, "null"); /* JSON has no nan or infinity; readers report where it is */
  } else if (value == 0) {
    length = sprintf(out, "0");
  } else {
    if (value < 0) *out = '-';
    length = cs__digits(size, count, out + (value < 0));
    if (length == 0) length = sprintf(out + (value < 0), "%.*g", count, size);
    length += value < 0;
  }
  text->size += (size_t)length;
}

static void cs__numbers(cs_recorder* r, cs__text* text, const char* key, const double* values,
                        int count) {
  int i;
  cs__put(r, text, key);
  for (i = 0; i < count; ++i) {
    cs__put(r, text, i ? "," : "[");
    cs__number(r, text, values[i]);
  }
  cs__put(r, text, count ? "]" : "[]");
}

/* Appends a JSON string. Invalid UTF-8 becomes question marks. */
static void cs__quoted(cs_recorder* r, cs__text* text, const char* words) {
  const unsigned char* c = (const unsigned char*)words;
  char one[8];
  cs__put(r, text, "\"");
  while (*c) {
    const int more = *c < 0x80                 ? 0
                     : *c >= 0xc2 && *c < 0xe0 ? 1
                     : *c >= 0xe0 && *c < 0xf0 ? 2
                     : *c >= 0xf0 && *c < 0xf5 ? 3
                                               : -1;
    int i, good = more >= 0;
    for (i = 1; i <= more && good; ++i) good = (c[i] & 0xc0) == 0x80;
    good = good && !(*c == 0xe0 && c[1] < 0xa0) && !(*c == 0xed && c[1] > 0x9f) &&
           !(*c == 0xf0 && c[1] < 0x90) && !(*c == 0xf4 && c[1] > 0x8f);
    if (!good) {
      sprintf(one, "?");
    } else if (*c < 0x20) {
      sprintf(one, "\\u%04x", (unsigned)*c);
    } else if (*c == '"' || *c == '\\') {
      sprintf(one, "\\%c", *c);
    } else {
      memcpy(one, c, (size_t)more + 1);
      one[more + 1] = 0;
    }
    cs__put(r, text, one);
    c += good ? more + 1 : 1;
  }
  cs__put(r, text, "\"");
}

/* Takes ownership of json->data. A duplicate name gets a numeric suffix. */
static int cs__add(cs_recorder* r, const char* name, cs__text* json) {
  cs__text quoted = {NULL, 0, 0};
  cs__shape shape = {NULL, NULL, -1, {{0, 0, 0}, {1, 0, 0, 0}}, {{0, 0, 0}, {1, 0, 0, 0}},
                     -1,   0,    0};
  size_t i = 0;
  int number = 1, id;
  cs__enter(r);
  cs__quoted(r, &quoted, name ? name : "shape");
  while (!r->failure && i < r->shape_count) {
    if (strcmp(r->shapes[i++].name, quoted.data) != 0) continue;
    if (number > 1)
      *strrchr(quoted.data, ' ') = 0, quoted.size = strlen(quoted.data);
    else
      quoted.data[--quoted.size] = 0;
    cs__put(r, &quoted, " ");
    cs__int(r, &quoted, ++number);
    cs__put(r, &quoted, "\"");
    i = 0;
  }
  id = CS__GROW(r, shapes, shape, 1) ? (int)r->shape_count++ : -1;
  if (id >= 0) {
    shape.name = quoted.data;
    shape.json = json ? json->data : NULL;
    shape.is_compound = json == NULL;
    r->shapes[id] = shape;
  } else {
    free(quoted.data);
    if (json) free(json->data);
  }
  cs__leave(r);
  return id;
}

/* cs__new_shapes() writes the closing brace, after the margin and the compound. */
static int cs__solid(cs_recorder* r, const char* name, const char* type, const double* vertices,
                     int count, const char* rest) {
  cs__text json = {NULL, 0, 0};
  int i;
  cs__put(r, &json, "{\"type\":\"");
  cs__put(r, &json, type);
  cs__put(r, &json, "\",\"vertices\":[");
  for (i = 0; i < count; ++i) cs__numbers(r, &json, i ? "," : "", vertices + 3 * i, 3);
  cs__put(r, &json, "]");
  cs__put(r, &json, rest);
  return cs__add(r, name, &json);
}

int cs_box(cs_recorder* r, const char* name, double x, double y, double z) {
  double v[24];
  int i;
  if (!r) return -1;
  for (i = 0; i < 8; ++i) {
    v[3 * i] = i & 1 ? x : -x;
    v[3 * i + 1] = i & 2 ? y : -y;
    v[3 * i + 2] = i & 4 ? z : -z;
  }
  return cs__solid(r, name, "box", v, 8,
                   ",\"faces\":[[0,4,6,2],[1,3,7,5],[0,1,5,4],[2,6,7,3],[0,2,3,1],[4,5,7,6]]");
}

int cs_capsule(cs_recorder* r, const char* name, const double from[3], const double to[3],
               double radius) {
  double ends[6];
  char rest[64];
  if (!r) return -1;
  memcpy(ends, from, sizeof(double) * 3);
  memcpy(ends + 3, to, sizeof(double) * 3);
  sprintf(rest, ",\"faces\":[],\"radius\":%.17g", radius);
  return cs__solid(r, name, "capsule", ends, 2, rest);
}

int cs_sphere(cs_recorder* r, const char* name, double radius) {
  const double center[3] = {0, 0, 0};
  char rest[64];
  if (!r) return -1;
  sprintf(rest, ",\"faces\":[],\"radius\":%.17g", radius);
  return cs__solid(r, name, "sphere", center, 1, rest);
}

int cs_hull(cs_recorder* r, const char* name, const double* vertices, int vertex_count) {
  return r ? cs__solid(r, name, "hull", vertices, vertex_count, "") : -1;
}

/* A ring of corners at -half_length, and at +half_length one of radius `top`, or the tip. */
static int cs__turned(cs_recorder* r, const char* name, const char* type, int axis,
                      double half_length, double radius, double top) {
  enum { kCorners = 64 };
  const double c = 0.99518472667219688624, s = 0.09801714032956060199; /* of 1/64 turn */
  double v[6 * kCorners], x = 1, y = 0;
  const int rings = top > 0 ? 2 : 1;
  int i, k;
  if (!r || axis < 0 || axis > 2) return -1;
  for (i = 0; i < kCorners; ++i) {
    const double turned = c * x - s * y;
    for (k = 0; k < rings; ++k) {
      double* corner = v + 3 * (k * kCorners + i);
      corner[axis] = k ? half_length : -half_length;
      corner[(axis + 1) % 3] = (k ? top : radius) * x;
      corner[(axis + 2) % 3] = (k ? top : radius) * y;
    }
    y = s * x + c * y;
    x = turned;
  }
  if (rings == 2) return cs__solid(r, name, type, v, 2 * kCorners, "");
  for (k = 0; k < 3; ++k) v[3 * kCorners + k] = k == axis ? half_length : 0;
  return cs__solid(r, name, type, v, kCorners + 1, "");
}

int cs_cylinder(cs_recorder* r, const char* name, int axis, double half_length, double radius) {
  return cs__turned(r, name, "cylinder", axis, half_length, radius, radius);
}

int cs_cone(cs_recorder* r, const char* name, int axis, double half_length, double radius) {
  return cs__turned(r, name, "cone", axis, half_length, radius, 0);
}

int cs_mesh(cs_recorder* r, const char* name, const double* vertices, int vertex_count,
            const int* triangles, int triangle_count) {
  cs__text rest = {NULL, 0, 0};
  int i, id;
  if (!r) return -1;
  cs__put(r, &rest, ",\"faces\":[");
  for (i = 0; i < 3 * triangle_count; ++i) {
    cs__put(r, &rest, i % 3 ? "," : i ? ",[" : "[");
    cs__int(r, &rest, triangles[i]);
    if (i % 3 == 2) cs__put(r, &rest, "]");
  }
  cs__put(r, &rest, "]");
  id = cs__solid(r, name, "mesh", vertices, vertex_count, rest.data ? rest.data : "");
  free(rest.data);
  return id;
}

int cs_plane(cs_recorder* r, const char* name, const double normal[3], double offset) {
  cs__text rest = {NULL, 0, 0};
  int id;
  if (!r) return -1;
  cs__numbers(r, &rest, ",\"faces\":[],\"half_space\":{\"normal\":", normal, 3);
  cs__put(r, &rest, ",\"offset\":");
  cs__number(r, &rest, offset);
  cs__put(r, &rest, "}");
  id = cs__solid(r, name, "plane", normal, 0, rest.data ? rest.data : "");
  free(rest.data);
  return id;
}

int cs_height_field(cs_recorder* r, const char* name, const double* heights, int columns, int rows,
                    double spacing) {
  const int vertex_count = columns * rows, cells = (columns - 1) * (rows - 1);
  double* vertices;
  int *triangles, x, y, id = -1, t = 0;
  if (!r || columns < 2 || rows < 2) return -1;
  vertices = (double*)malloc(sizeof(double) * 3 * (size_t)vertex_count);
  triangles = (int*)malloc(sizeof(int) * 6 * (size_t)cells);
  if (vertices && triangles) {
    for (y = 0; y < rows; ++y)
      for (x = 0; x < columns; ++x) {
        double* v = vertices + 3 * (y * columns + x);
        v[0] = x * spacing;
        v[r->settings.z_up ? 1 : 2] = r->settings.z_up ? y * spacing : -y * spacing;
        v[r->settings.z_up ? 2 : 1] = heights[y * columns + x];
      }
    for (y = 0; y + 1 < rows; ++y)
      for (x = 0; x + 1 < columns; ++x) {
        const int i = y * columns + x;
        const int corners[6] = {i, i + 1, i + columns + 1, i, i + columns + 1, i + columns};
        memcpy(triangles + 6 * t++, corners, sizeof corners);
      }
    id = cs_mesh(r, name, vertices, vertex_count, triangles, 2 * cells);
  }
  free(vertices);
  free(triangles);
  return id;
}

int cs_compound(cs_recorder* r, const char* name) {
  return r ? cs__add(r, name, NULL) : -1;
}

static int cs__known(const cs_recorder* r, int shape) {
  return r && shape >= 0 && (size_t)shape < r->shape_count;
}

void cs_margin(cs_recorder* r, int shape, double margin) {
  if (!cs__known(r, shape)) return;
  cs__enter(r);
  r->shapes[shape].margin = margin;
  cs__leave(r);
}

void cs_note(cs_recorder* r, const char* text) {
  size_t said;
  if (!r) return;
  cs__enter(r);
  said = r->notes.size;
  cs__put(r, &r->notes, "\n");
  cs__put(r, &r->notes, text);
  cs__put(r, &r->notes, "\n");
  if (!r->failure) {
    if (strstr(r->notes.data, r->notes.data + said) != r->notes.data + said) {
      r->notes.size = said;
      r->notes.data[said] = 0;
    } else {
      fprintf(stderr, "contactscope: %s\n", text);
    }
  }
  cs__leave(r);
}

static void cs__set(cs__pose* pose, const double position[3], const double rotation[4]) {
  memcpy(pose->position, position, sizeof pose->position);
  memcpy(pose->rotation, rotation, sizeof pose->rotation);
}

void cs_part(cs_recorder* r, int compound, int shape, const double position[3],
             const double quat_wxyz[4]) {
  if (!cs__known(r, compound) || !cs__known(r, shape) || compound == shape) return;
  cs__enter(r);
  r->shapes[shape].compound = compound;
  cs__set(&r->shapes[shape].in_compound, position, quat_wxyz);
  cs__leave(r);
}

cs_recorder* cs_start(const char* path, const char* scenario, const char* engine,
                      const char* version, const cs_settings* settings) {
  static const char* const kMoments[] = {NULL, "before_step", "after_step"};
  cs_recorder* r = (cs_recorder*)calloc(1, sizeof *r);
  if (!r) return NULL;
  if (settings) r->settings = *settings;
  r->file = fopen(path, "wb");
  if (!r->file) {
    free(r);
    return NULL;
  }
  cs__put(r, &r->head, "{\"schema\":\"contactscope.trace/1\",\"scenario\":");
  cs__quoted(r, &r->head, scenario);
  cs__put(r, &r->head, ",\"scalar\":");
  cs__put(r, &r->head, r->settings.doubles ? "\"double\"" : "\"float\"");
  cs__put(r, &r->head, r->settings.z_up ? ",\"up\":\"z\"" : ",\"up\":\"y\"");
  if (engine) cs__put(r, &r->head, ",\"engine\":"), cs__quoted(r, &r->head, engine);
  if (version) cs__put(r, &r->head, ",\"version\":"), cs__quoted(r, &r->head, version);
  if (r->settings.poses_at == 1 || r->settings.poses_at == 2) {
    cs__put(r, &r->head, ",\"poses_at\":");
    cs__quoted(r, &r->head, kMoments[r->settings.poses_at]);
  }
  if (r->settings.force_step > 0 || r->settings.friction_on_a) {
    char step[48];
    sprintf(step, ",\"step\":%.17g", r->settings.force_step);
    cs__put(r, &r->head, ",\"impulses\":{\"unit\":");
    cs__put(r, &r->head, r->settings.force_step > 0 ? "\"N\"" : "\"N s\"");
    cs__put(r, &r->head, r->settings.friction_on_a ? ",\"on\":\"a\"" : ",\"on\":\"b\"");
    if (r->settings.force_step > 0) cs__put(r, &r->head, step);
    cs__put(r, &r->head, "}");
  }
  return r;
}

const char* cs_failure(const cs_recorder* r) {
  return r ? r->failure : NULL;
}

/* Shapes that are not in the file yet. */
static void cs__new_shapes(cs_recorder* r, cs__text* text) {
  const char* comma = "";
  size_t i;
  cs__put(r, text, ",\"shapes\":{");
  for (i = 0; i < r->shape_count; ++i) {
    if (!r->shapes[i].json) continue;
    cs__put(r, text, comma);
    cs__put(r, text, r->shapes[i].name);
    cs__put(r, text, ":");
    cs__put(r, text, r->shapes[i].json);
    if (r->shapes[i].margin > 0) {
      cs__put(r, text, ",\"margin\":");
      cs__number(r, text, r->shapes[i].margin);
    }
    if (r->shapes[i].compound >= 0) {
      cs__put(r, text, ",\"body\":");
      cs__put(r, text, r->shapes[r->shapes[i].compound].name);
    }
    cs__put(r, text, "}");
    free(r->shapes[i].json);
    r->shapes[i].json = NULL;
    comma = ",";
  }
  cs__put(r, text, "}");
}

static void cs__write(cs_recorder* r, cs__text* text) {
  cs__put(r, text, "}\n");
  if (r->failure) return;
  if (fwrite(text->data, 1, text->size, r->file) != text->size || fflush(r->file) != 0)
    r->failure = "the file cannot be written";
}

void cs_stop(cs_recorder* r) {
  size_t i;
  if (!r) return;
  if (r->in_frame) cs_end_frame(r);
  if (!r->has_header) {
    cs__new_shapes(r, &r->head);
    cs__write(r, &r->head);
  }
  fclose(r->file);
  for (i = 0; i < r->shape_count; ++i) {
    free(r->shapes[i].name);
    free(r->shapes[i].json);
  }
  free(r->line.data);
  free(r->head.data);
  free(r->notes.data);
  free(r->shapes);
  free(r->manifolds);
  free(r->points);
  free(r->bodies);
  free(r);
}

void cs_begin_frame(cs_recorder* r, double time) {
  if (!r) return;
  if (r->in_frame) cs_end_frame(r);
  if (!r->has_header) {
    cs__new_shapes(r, &r->head);
    cs__write(r, &r->head);
    r->has_header = 1;
  }
  r->in_frame = 1;
  r->time = time;
  r->manifold_count = r->point_count = r->body_count = 0;
  r->has_solver = 0;
}

void cs_pose(cs_recorder* r, int shape, const double position[3], const double quat_wxyz[4]) {
  if (!cs__known(r, shape)) return;
  cs__enter(r);
  cs__set(&r->shapes[shape].pose, position, quat_wxyz);
  r->shapes[shape].posed_in = r->frame;
  cs__leave(r);
}

void cs_manifold(cs_recorder* r, int a, int b, const double normal[3], int triangle,
                 const cs_point* points, int count) {
  const int turned = a > b;
  int i, k;
  if (!cs__known(r, a) || !cs__known(r, b) || a == b || count < 1) return;
  cs__enter(r);
  if (r->in_frame && CS__GROW(r, manifolds, manifold, 1) &&
      CS__GROW(r, points, point, (size_t)count)) {
    cs__manifold* m = &r->manifolds[r->manifold_count++];
    m->a = turned ? b : a;
    m->b = turned ? a : b;
    m->triangle = triangle;
    m->count = count;
    m->first = r->point_count;
    for (k = 0; k < 3; ++k) {
      m->normal[k] = turned ? -normal[k] : normal[k];
      m->place[k] = points[0].position[k];
    }
    for (i = 0; i < count; ++i) {
      cs_point* p = &r->points[r->point_count++];
      *p = points[i];
      if (!turned) continue;
      memcpy(p->on_a, points[i].on_b, sizeof p->on_a);
      memcpy(p->on_b, points[i].on_a, sizeof p->on_b);
      for (k = 0; k < 3; ++k) p->friction[k] = -p->friction[k];
    }
  }
  cs__leave(r);
}

void cs_body(cs_recorder* r, int shape, double mass, const double center_of_mass[3],
             const double velocity[3], const double angular_velocity[3]) {
  if (!cs__known(r, shape)) return;
  cs__enter(r);
  if (r->in_frame && CS__GROW(r, bodies, body, 1)) {
    cs__body* body = &r->bodies[r->body_count++];
    body->shape = shape;
    body->mass = mass;
    memcpy(body->numbers[0], center_of_mass, sizeof body->numbers[0]);
    memcpy(body->numbers[1], velocity, sizeof body->numbers[0]);
    memcpy(body->numbers[2], angular_velocity, sizeof body->numbers[0]);
  }
  cs__leave(r);
}

void cs_solver(cs_recorder* r, int iterations, int substeps, int warm_start) {
  if (!r || !r->in_frame) return;
  r->has_solver = 1;
  r->solver[0] = iterations;
  r->solver[1] = substeps;
  r->solver[2] = warm_start;
}

static void cs__turn(const double q[4], const double v[3], double out[3]) {
  double t[3];
  int k;
  for (k = 0; k < 3; ++k)
    t[k] = 2 * (q[1 + (k + 1) % 3] * v[(k + 2) % 3] - q[1 + (k + 2) % 3] * v[(k + 1) % 3]);
  for (k = 0; k < 3; ++k)
    out[k] = v[k] + q[0] * t[k] + q[1 + (k + 1) % 3] * t[(k + 2) % 3] -
             q[1 + (k + 2) % 3] * t[(k + 1) % 3];
}

/* World pose of a part of a compound. */
static void cs__compose(const cs__pose* whole, const cs__pose* part, cs__pose* out) {
  const double *p = whole->rotation, *q = part->rotation;
  int k;
  cs__turn(p, part->position, out->position);
  for (k = 0; k < 3; ++k) out->position[k] += whole->position[k];
  out->rotation[0] = p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3];
  out->rotation[1] = p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2];
  out->rotation[2] = p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1];
  out->rotation[3] = p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0];
}

static int cs__by_pair(const void* one, const void* other) {
  const cs__manifold *m = (const cs__manifold*)one, *n = (const cs__manifold*)other;
  int k, order = m->a != n->a   ? m->a - n->a
                 : m->b != n->b ? m->b - n->b
                                : m->triangle - n->triangle;
  for (k = 0; k < 3 && order == 0; ++k)
    order = (m->place[k] > n->place[k]) - (m->place[k] < n->place[k]);
  for (k = 0; k < 3 && order == 0; ++k)
    order = (m->normal[k] > n->normal[k]) - (m->normal[k] < n->normal[k]);
  return order;
}

static int cs__by_shape(const void* one, const void* other) {
  return ((const cs__body*)one)->shape - ((const cs__body*)other)->shape;
}

static void cs__point(cs_recorder* r, const cs_point* p) {
  cs__text* t = &r->line;
  char digits[24];
  cs__numbers(r, t, "{\"position\":", p->position, 3);
  cs__put(r, t, ",\"separation\":");
  cs__number(r, t, p->separation);
  if (p->has_id) {
    uint64_t id = p->id;
    int i = 23;
    digits[i] = 0;
    do digits[--i] = (char)('0' + id % 10);
    while (id /= 10);
    cs__put(r, t, ",\"id\":\"");
    cs__put(r, t, digits + i);
    cs__put(r, t, "\"");
  }
  if (p->has_impulse) {
    cs__put(r, t, ",\"impulse\":{\"normal\":");
    cs__number(r, t, p->impulse);
    cs__numbers(r, t, ",\"friction\":", p->friction, 3);
    cs__put(r, t, "}");
  }
  if (p->has_sides) {
    cs__numbers(r, t, ",\"on_a\":", p->on_a, 3);
    cs__numbers(r, t, ",\"on_b\":", p->on_b, 3);
  }
  cs__put(r, t, p->idle ? ",\"active\":false}" : "}");
}

static void cs__pairs(cs_recorder* r) {
  cs__text* t = &r->line;
  size_t i;
  int k;
  if (r->manifold_count) qsort(r->manifolds, r->manifold_count, sizeof *r->manifolds, cs__by_pair);
  cs__put(r, t, "},\"pairs\":[");
  for (i = 0; i < r->manifold_count; ++i) {
    const cs__manifold* m = &r->manifolds[i];
    if (i > 0 && m[-1].a == m->a && m[-1].b == m->b) {
      cs__put(r, t, ",");
    } else {
      cs__put(r, t, i ? "]},{\"a\":" : "{\"a\":");
      cs__put(r, t, r->shapes[m->a].name);
      cs__put(r, t, ",\"b\":");
      cs__put(r, t, r->shapes[m->b].name);
      cs__put(r, t, ",\"manifolds\":[");
    }
    cs__numbers(r, t, "{\"normal\":", m->normal, 3);
    if (m->triangle >= 0) {
      cs__put(r, t, ",\"triangle\":");
      cs__int(r, t, m->triangle);
    }
    for (k = 0; k < m->count; ++k) {
      cs__put(r, t, k ? "," : ",\"points\":[");
      cs__point(r, &r->points[m->first + (size_t)k]);
    }
    cs__put(r, t, "]}");
  }
  cs__put(r, t, r->manifold_count ? "]}]" : "]");
}

static void cs__solved(cs_recorder* r) {
  static const char* const kKeys[] = {
      ",\"center_of_mass\":", ",\"velocity\":", ",\"angular_velocity\":"};
  cs__text* t = &r->line;
  size_t i;
  int k;
  if (!r->has_solver && r->body_count == 0) return;
  if (r->body_count) qsort(r->bodies, r->body_count, sizeof *r->bodies, cs__by_shape);
  cs__put(r, t, ",\"solver\":{\"iterations\":");
  cs__int(r, t, r->has_solver ? r->solver[0] : 0);
  cs__put(r, t, ",\"substeps\":");
  cs__int(r, t, r->has_solver ? r->solver[1] : 0);
  cs__put(r, t,
          r->has_solver && r->solver[2] ? ",\"warm_start\":true,\"bodies\":{" : ",\"bodies\":{");
  for (i = 0; i < r->body_count; ++i) {
    cs__put(r, t, i ? "," : "");
    cs__put(r, t, r->shapes[r->bodies[i].shape].name);
    cs__put(r, t, ":{\"mass\":");
    cs__number(r, t, r->bodies[i].mass);
    for (k = 0; k < 3; ++k) cs__numbers(r, t, kKeys[k], r->bodies[i].numbers[k], 3);
    cs__put(r, t, "}");
  }
  cs__put(r, t, "}}");
}

void cs_end_frame(cs_recorder* r) {
  const char* comma = "";
  size_t i;
  if (!r || !r->in_frame) return;
  r->line.size = 0;
  cs__put(r, &r->line, "{\"frame\":");
  cs__int(r, &r->line, r->frame);
  cs__put(r, &r->line, ",\"time\":");
  cs__number(r, &r->line, r->time);
  cs__new_shapes(r, &r->line);
  cs__put(r, &r->line, ",\"poses\":{");
  for (i = 0; i < r->shape_count; ++i) {
    cs__shape* shape = &r->shapes[i];
    if (shape->compound >= 0 && r->shapes[shape->compound].posed_in == r->frame) {
      cs__compose(&r->shapes[shape->compound].pose, &shape->in_compound, &shape->pose);
      shape->posed_in = r->frame;
    }
    if (shape->posed_in != r->frame || shape->is_compound) continue;
    cs__put(r, &r->line, comma);
    cs__put(r, &r->line, shape->name);
    cs__numbers(r, &r->line, ":{\"position\":", shape->pose.position, 3);
    cs__numbers(r, &r->line, ",\"quat_wxyz\":", shape->pose.rotation, 4);
    cs__put(r, &r->line, "}");
    comma = ",";
  }
  cs__pairs(r);
  cs__solved(r);
  cs__write(r, &r->line);
  r->in_frame = 0;
  ++r->frame;
}

#endif /* CONTACTSCOPE_IMPLEMENTATION */
