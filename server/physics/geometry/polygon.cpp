#include "physics/geometry/polygon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <sstream>

#include "physics/geometry/predicates.h"
#include "physics/geometry/trigonometry.h"

namespace urto {
namespace {

using Points = std::vector<Vec2>;
using Indices = std::vector<std::size_t>;

// Of the polygon's extent: vertices nearer to the line of their neighbours than this are left out, and so are parts
// that are thinner. A few times the rounding of a float world's vertices (6e-8), which would bend such a corner
// inwards.
constexpr double kFlatness = 1e-6;

// A box of the least size allowed must pass whatever its angle; this is beyond the rounding of its vertices.
constexpr double kSizeMinRounded = kSizeMin * (1 - 1e-9);

double cross_of(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

std::string text_of(double value) {
  std::ostringstream out;
  out.precision(9);
  out << value;
  return out.str();
}

std::string text_of(const Vec2& v) {
  std::string out("(");
  out.append(text_of(v.x())).append(", ").append(text_of(v.y())).append(")");
  return out;
}

std::string vertex_field(std::size_t i) {
  std::string out("vertices[");
  return out.append(std::to_string(i)).append("]");
}

double extent_of(const Points& points) {
  Vec2 low = points[0], high = points[0];
  for (const Vec2& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).maxCoeff();
}

double distance_to_line(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 edge = b - a;
  const double size = edge.norm();
  return size > 0 ? std::abs(cross_of(edge, p - a)) / size : (p - a).norm();
}

// The least distance between two parallel lines that hold all the points; over the directions of the hull's edges,
// which are among those of all pairs.
double width_of(const Points& points) {
  double width = extent_of(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      const Vec2 edge = points[j] - points[i];
      const double size = edge.norm();
      if (size == 0) continue;
      double low = 0, high = 0;
      for (const Vec2& p : points) {
        const double offset = cross_of(edge, p - points[i]) / size;
        low = std::min(low, offset);
        high = std::max(high, offset);
      }
      width = std::min(width, high - low);
    }
  }
  return width;
}

double signed_area(const Points& points) {
  double twice = 0;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    twice += cross_of(points[i] - points[0], points[i + 1] - points[0]);
  }
  return 0.5 * twice;
}

Status check_values(const Points& vertices, const char* what, std::size_t least, std::size_t most) {
  if (vertices.size() < least || vertices.size() > most) {
    return failure(
        ErrorCode::kInvalidValue, "vertices", std::to_string(vertices.size()),
        std::string(what) + " needs " + std::to_string(least) + " to " + std::to_string(most) + " vertices.");
  }
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    for (const double value : {vertices[i].x(), vertices[i].y()}) {
      if (!std::isfinite(value) || std::abs(value) > kSizeMax) {
        return failure(ErrorCode::kInvalidValue, vertex_field(i), text_of(vertices[i]),
                       "A coordinate must be finite and within ±" + text_of(kSizeMax) + " m.");
      }
    }
  }
  return {};
}

// Edges long enough, no two of them meeting but neighbours in their common vertex, and some thickness.
Status check_simple(const Points& v) {
  const std::size_t n = v.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = (i + 1) % n;
    if ((v[next] - v[i]).norm() < kSizeMinRounded) {
      return failure(ErrorCode::kDegenerateShape, vertex_field(next), text_of(v[next]),
                     "Neighbouring vertices must be at least " + text_of(kSizeMin) + " m apart.");
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t i1 = (i + 1) % n, i2 = (i + 2) % n;
    const bool folds_back = orientation(v[i], v[i1], v[i2]) == 0 && (v[i1] - v[i]).dot(v[i2] - v[i1]) < 0;
    if (folds_back) {
      return failure(ErrorCode::kDegenerateShape, vertex_field(i1), text_of(v[i1]),
                     "The edges at a vertex must not lie on each other.");
    }
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;
      if (segments_meet(v[i], v[i1], v[j], v[(j + 1) % n])) {
        return failure(ErrorCode::kDegenerateShape, vertex_field(j), text_of(v[j]),
                       "The edge that starts here meets the edge from vertex " + std::to_string(i) + ".");
      }
    }
  }
  const double width = width_of(v);
  if (width < kSizeMinRounded) {
    return failure(ErrorCode::kDegenerateShape, "vertices", text_of(width),
                   "The polygon must be at least " + text_of(kSizeMin) + " m thick.");
  }
  return {};
}

// Leaves out vertices on the line of their neighbours. Every vertex left out stays within tolerance of the edge that
// replaces it, so that an arc of many small turns does not become its chord.
Points without_flat_vertices(const Points& v, double tolerance) {
  const std::size_t n = v.size();
  std::vector<bool> kept(n, true);
  std::size_t left = n;
  const auto neighbour = [&](std::size_t i, std::size_t step) {
    do i = (i + step) % n;
    while (!kept[i]);
    return i;
  };
  for (std::size_t i = 0; i < n && left > 3; ++i) {
    const std::size_t before = neighbour(i, n - 1), after = neighbour(i, 1);
    bool flat = (v[i] - v[before]).dot(v[after] - v[i]) > 0;
    for (std::size_t k = (before + 1) % n; flat && k != after; k = (k + 1) % n) {
      flat = distance_to_line(v[k], v[before], v[after]) <= tolerance;
    }
    if (flat) {
      kept[i] = false;
      --left;
    }
  }
  Points out;
  for (std::size_t i = 0; i < n; ++i) {
    if (kept[i]) out.push_back(v[i]);
  }
  return out;
}

bool is_convex(const Points& v) {
  for (std::size_t i = 0; i < v.size(); ++i) {
    if (orientation(v[i], v[(i + 1) % v.size()], v[(i + 2) % v.size()]) <= 0) return false;
  }
  return true;
}

// Cuts caps of kPolygonVerticesMax vertices off a convex polygon, going around it, until the core is small enough:
// the least number of parts, ⌈(n − 2)/(max − 2)⌉.
std::vector<Points> split_convex(Points rest) {
  std::vector<Points> parts;
  std::size_t start = 0;
  while (rest.size() > kPolygonVerticesMax) {
    Points cap;
    Indices inner;
    const std::size_t count = std::min<std::size_t>(kPolygonVerticesMax, rest.size() - kPolygonVerticesMax + 2);
    for (std::size_t k = 0; k < count; ++k) {
      cap.push_back(rest[(start + k) % rest.size()]);
      if (k > 0 && k + 1 < count) inner.push_back((start + k) % rest.size());
    }
    parts.push_back(std::move(cap));
    const Vec2 next = rest[(start + count - 1) % rest.size()];
    std::sort(inner.begin(), inner.end());
    for (std::size_t k = inner.size(); k-- > 0;) rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(inner[k]));
    start = static_cast<std::size_t>(std::find(rest.begin(), rest.end(), next) - rest.begin());
  }
  parts.push_back(std::move(rest));
  return parts;
}

// The sine of the smallest angle of a triangle, near enough: the least height over the longest edge.
double triangle_quality(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return std::abs(cross_of(b - a, c - a)) / longest;
}

bool is_ear(const Points& v, const Indices& ring, std::size_t k) {
  const std::size_t n = ring.size();
  const std::size_t ia = ring[(k + n - 1) % n], ib = ring[k], ic = ring[(k + 1) % n];
  if (orientation(v[ia], v[ib], v[ic]) <= 0) return false;
  for (const std::size_t i : ring) {
    if (i == ia || i == ib || i == ic) continue;
    if (orientation(v[ia], v[ib], v[i]) >= 0 && orientation(v[ib], v[ic], v[i]) >= 0 &&
        orientation(v[ic], v[ia], v[i]) >= 0) {
      return false;
    }
  }
  return true;
}

// Ear clipping (Meisters 1975), the best-shaped ear first. Every simple polygon has an ear, and exact predicates find
// it; an empty answer would mean that the polygon is not simple.
std::vector<Indices> triangulate(const Points& v) {
  Indices ring(v.size());
  for (std::size_t i = 0; i < ring.size(); ++i) ring[i] = i;
  std::vector<Indices> triangles;
  while (ring.size() >= 3) {
    const std::size_t n = ring.size();
    std::size_t best = n;
    double best_quality = -1;
    for (std::size_t k = 0; k < n; ++k) {
      const double quality = triangle_quality(v[ring[(k + n - 1) % n]], v[ring[k]], v[ring[(k + 1) % n]]);
      if (quality > best_quality && is_ear(v, ring, k)) {
        best = k;
        best_quality = quality;
      }
    }
    if (best == n) return {};
    triangles.push_back({ring[(best + n - 1) % n], ring[best], ring[(best + 1) % n]});
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(best));
  }
  return triangles;
}

// How a corner of a merged part turns: kConvex stays a vertex, kFlat is left out, kReflex forbids the merge.
enum class Corner { kConvex, kFlat, kReflex };

Corner corner_of(const Vec2& before, const Vec2& at, const Vec2& after, double tolerance) {
  const int turn = orientation(before, at, after);
  if (turn == 0) return Corner::kFlat;
  return turn > 0 && distance_to_line(at, before, after) > tolerance ? Corner::kConvex : Corner::kReflex;
}

// a and b across their common edge, a's edge i: the merged ring, or an empty one if it is not convex or too large.
Indices merged(const Points& v, const Indices& a, std::size_t i, const Indices& b, std::size_t j, double tolerance) {
  Indices ring;
  for (std::size_t k = 0; k < a.size(); ++k) ring.push_back(a[(i + 1 + k) % a.size()]);
  for (std::size_t k = 1; k + 1 < b.size(); ++k) ring.push_back(b[(j + 1 + k) % b.size()]);
  // The corners that changed are where the edge ended: places 0 and a.size() − 1.
  for (const std::size_t place : {a.size() - 1, std::size_t{0}}) {
    const std::size_t n = ring.size();
    const Corner corner = corner_of(v[ring[(place + n - 1) % n]], v[ring[place]], v[ring[(place + 1) % n]], tolerance);
    if (corner == Corner::kReflex) return {};
    if (corner == Corner::kFlat) ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(place));
  }
  return ring.size() <= kPolygonVerticesMax ? ring : Indices{};
}

// Where parts a and b share an edge, in opposite senses.
bool find_common_edge(const Indices& a, const Indices& b, std::size_t& i, std::size_t& j) {
  for (i = 0; i < a.size(); ++i) {
    for (j = 0; j < b.size(); ++j) {
      if (a[i] == b[(j + 1) % b.size()] && a[(i + 1) % a.size()] == b[j]) return true;
    }
  }
  return false;
}

// Hertel and Mehlhorn 1983: removes diagonals while the parts stay convex. longest_first also decides which diagonal
// goes first, as theirs does not.
std::vector<Indices> merge_parts(const Points& v, std::vector<Indices> parts, double tolerance, bool longest_first) {
  for (;;) {
    std::size_t best_a = 0, best_b = 0;
    double best_length = -1;
    Indices best;
    for (std::size_t a = 0; a < parts.size(); ++a) {
      for (std::size_t b = a + 1; b < parts.size(); ++b) {
        std::size_t i, j;
        if (!find_common_edge(parts[a], parts[b], i, j)) continue;
        const double size = (v[parts[a][i]] - v[parts[b][j]]).squaredNorm();
        if (best_length >= 0 && (longest_first ? size <= best_length : size >= best_length)) continue;
        Indices ring = merged(v, parts[a], i, parts[b], j, tolerance);
        if (ring.empty()) continue;
        best_a = a;
        best_b = b;
        best_length = size;
        best = std::move(ring);
      }
    }
    if (best_length < 0) return parts;
    parts[best_a] = std::move(best);
    parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(best_b));
  }
}

std::vector<Points> split_concave(const Points& v, double tolerance) {
  const std::vector<Indices> triangles = triangulate(v);
  std::vector<Indices> parts = merge_parts(v, triangles, tolerance, true);
  std::vector<Indices> other = merge_parts(v, triangles, tolerance, false);
  if (other.size() < parts.size()) parts = std::move(other);
  std::vector<Points> out;
  for (const Indices& part : parts) {
    Points points;
    for (const std::size_t i : part) points.push_back(v[i]);
    if (width_of(points) > tolerance) out.push_back(std::move(points));
  }
  return out;
}

}  // namespace

AreaProperties polygon_area_properties(const std::vector<Vec2>& counter_clockwise) {
  AreaProperties out;
  if (counter_clockwise.empty()) return out;
  // About the mean of the vertices, so that a polygon far from its origin loses nothing.
  Vec2 origin{0, 0};
  for (const Vec2& v : counter_clockwise) origin += v;
  origin /= static_cast<double>(counter_clockwise.size());
  double area = 0, moment = 0;
  Vec2 first{0, 0};
  for (std::size_t i = 0; i < counter_clockwise.size(); ++i) {
    const Vec2 a = counter_clockwise[i] - origin;
    const Vec2 b = counter_clockwise[(i + 1) % counter_clockwise.size()] - origin;
    const double twice = cross_of(a, b);
    area += 0.5 * twice;
    first += (twice / 6) * (a + b);
    moment += (twice / 12) * (a.dot(a) + a.dot(b) + b.dot(b));
  }
  if (area == 0) return {0, origin, 0};
  const Vec2 offset = first / area;
  out.area = area;
  out.centroid = origin + offset;
  out.second_moment = moment - area * offset.dot(offset);
  return out;
}

AreaProperties circle_area_properties(double radius, const Vec2& center) {
  constexpr double kPi = 3.14159265358979323846;
  const double area = kPi * radius * radius;
  return {area, center, 0.5 * area * radius * radius};
}

AreaProperties box_area_properties(double width, double height, const Vec2& center) {
  const double area = width * height;
  return {area, center, area * (width * width + height * height) / 12};
}

AreaProperties rounded_area_properties(const std::vector<Vec2>& counter_clockwise, double radius) {
  const std::size_t n = counter_clockwise.size();
  AreaProperties core = polygon_area_properties(counter_clockwise);
  if (n < 3) core = {0, 0.5 * (counter_clockwise[0] + counter_clockwise[1]), 0};
  if (radius == 0) return core;
  // About the centroid of the core: the core, a strip along each edge, and a sector at each vertex.
  double area = core.area, moment = core.second_moment;
  Vec2 first{0, 0};
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 before = counter_clockwise[(i + n - 1) % n], at = counter_clockwise[i];
    const Vec2 after = counter_clockwise[(i + 1) % n];
    const Vec2 in = at - before, out = after - at;
    const double size = out.norm();
    const Vec2 n0 = Vec2(in.y(), -in.x()) / in.norm(), n1 = Vec2(out.y(), -out.x()) / size;
    const double strip = size * radius;
    const Vec2 middle = 0.5 * (at + after) + 0.5 * radius * n1 - core.centroid;
    area += strip;
    first += strip * middle;
    moment += strip * ((size * size + radius * radius) / 12 + middle.dot(middle));
    // Sector between the normals n0 and n1: area r²θ/2; ∫ r dA = r³/3 · (n1.y − n0.y, n0.x − n1.x); ∫ r² dA = r⁴θ/4.
    const double angle = atan2_of(cross_of(n0, n1), n0.dot(n1));
    const double sector = 0.5 * radius * radius * angle;
    const Vec2 sector_first = radius * radius * radius / 3 * Vec2(n1.y() - n0.y(), n0.x() - n1.x());
    const Vec2 corner = at - core.centroid;
    area += sector;
    first += sector * corner + sector_first;
    moment += 0.5 * sector * radius * radius + 2 * corner.dot(sector_first) + sector * corner.dot(corner);
  }
  const Vec2 offset = first / area;
  return {area, core.centroid + offset, moment - area * offset.dot(offset)};
}

Status check_chain(const std::vector<Vec2>& v, bool loop) {
  if (Status status = check_values(v, "A chain", loop ? 3 : 2, kChainVerticesMax); !status) return status;
  const std::size_t n = v.size();
  for (std::size_t i = 0; i + 1 < n || (loop && i < n); ++i) {
    const std::size_t next = (i + 1) % n, second = (i + 2) % n;
    if ((v[next] - v[i]).norm() < kSizeMinRounded) {
      return failure(ErrorCode::kDegenerateShape, vertex_field(next), text_of(v[next]),
                     "Neighbouring vertices must be at least " + text_of(kSizeMin) + " m apart.");
    }
    if (!loop && i + 2 >= n) continue;
    if (orientation(v[i], v[next], v[second]) == 0 && (v[next] - v[i]).dot(v[second] - v[next]) < 0) {
      return failure(ErrorCode::kDegenerateShape, vertex_field(next), text_of(v[next]),
                     "The edges at a vertex must not lie on each other.");
    }
  }
  return {};
}

Expected<std::vector<std::vector<Vec2>>> decompose_polygon(const std::vector<Vec2>& vertices) {
  if (Status status = check_values(vertices, "A polygon", 3, kPolygonInputVerticesMax); !status)
    return tl::unexpected<Error>(status.error());
  if (Status status = check_simple(vertices); !status) return tl::unexpected<Error>(status.error());
  const double tolerance = kFlatness * extent_of(vertices);
  Points outline = without_flat_vertices(vertices, tolerance);
  if (signed_area(outline) < 0) std::reverse(outline.begin(), outline.end());
  if (is_convex(outline)) return split_convex(std::move(outline));
  std::vector<Points> parts = split_concave(outline, tolerance);
  if (parts.empty()) {
    return failure(ErrorCode::kDegenerateShape, "vertices", std::to_string(vertices.size()),
                   "The polygon is too thin everywhere to be split into convex parts.");
  }
  return parts;
}

}  // namespace urto
