// What the kernels of outlines share: the outlines of a few lanes' shapes, and the steps of SAT on them. Included once
// for each instruction set (Highway's pattern for headers), inside a file that Highway compiles for all of them.
#if defined(URTO_PHYSICS_NARROW_PHASE_OUTLINE_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef URTO_PHYSICS_NARROW_PHASE_OUTLINE_LANES_INL_H_
#undef URTO_PHYSICS_NARROW_PHASE_OUTLINE_LANES_INL_H_
#else
#define URTO_PHYSICS_NARROW_PHASE_OUTLINE_LANES_INL_H_
#endif

#include "physics/narrow_phase/outline.h"
#include "physics/narrow_phase/place_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace urto {
namespace HWY_NAMESPACE {

template <class S>
HWY_INLINE Pair<S> rotated(Pair<S> q, Pair<S> v) {
  return {hn::Sub(hn::Mul(q.x, v.x), hn::Mul(q.y, v.y)), hn::Add(hn::Mul(q.y, v.x), hn::Mul(q.x, v.y))};
}
template <class S>
HWY_INLINE Pair<S> rotated_back(Pair<S> q, Pair<S> v) {
  return {hn::Add(hn::Mul(q.x, v.x), hn::Mul(q.y, v.y)), hn::Sub(hn::Mul(q.x, v.y), hn::Mul(q.y, v.x))};
}

constexpr int kMost = static_cast<int>(kPolygonVerticesMax);

// The outlines of a few lanes' shapes. Lanes with fewer vertices than the most of them end in copies of their first
// vertex and face.
template <class S>
struct Outlines {
  Pair<S> vertices[kMost + 1];  // ccw; the first again behind the last
  Pair<S> normals[kMost];
  Vector<S> count;
  int most;

  HWY_INLINE Outlines(const OutlineRows<S>* outlines, const std::uint32_t* proxies, Vector<S> counts, int most_vertices)
      : count(counts), most(most_vertices) {
    int k = 0;
    do {
      const auto row = load_rows<S>([&](std::size_t i) { return outlines[proxies[i]].rows[k]; });
      vertices[k] = {row.c0, row.c1};
      normals[k] = {row.c2, row.c3};
    } while (++k < most);
    vertices[most] = vertices[0];
  }

  HWY_INLINE void place(Pair<S> q, Pair<S> center) {
    int k = 0;
    do {
      const Pair<S> v = rotated<S>(q, vertices[k]);
      vertices[k] = {hn::Add(v.x, center.x), hn::Add(v.y, center.y)};
      normals[k] = rotated<S>(q, normals[k]);
    } while (++k < most);
    vertices[most] = vertices[0];
  }
};

// The face of a against which b is separated most. Copies of the first vertex at the end of a short outline change
// nothing: their faces repeat the first one's.
template <class S>
struct BestFace {
  Pair<S> normal, start, end;
  Vector<S> separation, index;

  HWY_INLINE BestFace(const Outlines<S>& a, const Outlines<S>& b)
      : normal(a.normals[0]), start(a.vertices[0]), end(a.vertices[1]), separation(separation_from(a, b, 0)) {
    index = hn::Zero(Tag<S>());
    for (int i = 1; i < a.most; ++i) {
      const auto s = separation_from(a, b, i);
      const auto better = hn::Gt(s, separation);
      normal = choose<S>(better, a.normals[i], normal);
      start = choose<S>(better, a.vertices[i], start);
      end = choose<S>(better, a.vertices[i + 1], end);
      separation = hn::IfThenElse(better, s, separation);
      index = hn::IfThenElse(better, set(S(i)), index);
    }
  }

 private:
  static HWY_INLINE Vector<S> separation_from(const Outlines<S>& a, const Outlines<S>& b, int i) {
    auto least = dot<S>(a.normals[i], b.vertices[0]);
    // Min may give a zero of another sign on another machine; separations of faces are only compared.
    for (int j = 1; j < b.most; ++j) least = hn::Min(least, dot<S>(a.normals[i], b.vertices[j]));
    return hn::Sub(least, dot<S>(a.normals[i], a.vertices[i]));
  }
};

// The edge that looks most against a direction.
template <class S>
struct IncidentEdge {
  Pair<S> p, q;
  Vector<S> p_index, q_index;

  HWY_INLINE IncidentEdge(const Outlines<S>& a, const Outlines<S>& b, Mask<S> of_a, Pair<S> direction) {
    const int most = a.most > b.most ? a.most : b.most;
    const auto count = hn::IfThenElse(of_a, a.count, b.count);
    const auto pick = [&](int k) HWY_ATTR -> Pair<S> {
      return choose<S>(of_a, a.vertices[k < a.most ? k : a.most], b.vertices[k < b.most ? k : b.most]);
    };
    const auto first = dot<S>(choose<S>(of_a, a.normals[0], b.normals[0]), direction);
    auto least = first;
    p = pick(0);
    q = pick(1);
    p_index = hn::Zero(Tag<S>());
    for (int k = 1; k < most; ++k) {
      const Pair<S> normal = choose<S>(of_a, a.normals[k < a.most ? k : 0], b.normals[k < b.most ? k : 0]);
      const auto d = dot<S>(normal, direction);
      const auto less = hn::Lt(d, least);
      least = hn::IfThenElse(less, d, least);
      p = choose<S>(less, pick(k), p);
      q = choose<S>(less, pick(k + 1), q);
      p_index = hn::IfThenElse(less, set(S(k)), p_index);
    }
    const auto next = hn::Add(p_index, set(S(1)));
    q_index = hn::IfThenElse(hn::Lt(next, count), next, hn::Zero(Tag<S>()));
  }
};

// The most vertices of any lane, `least` or more.
template <class S>
HWY_INLINE int most_of(Vector<S> counts, int least) {
  HWY_ALIGN S lanes[kLanes<S>];
  store(counts, lanes);
  S most = S(least);
  for (std::size_t i = 0; i < hn::Lanes(Tag<S>()); ++i) most = lanes[i] > most ? lanes[i] : most;
  return static_cast<int>(most);
}

}  // namespace HWY_NAMESPACE
}  // namespace urto
HWY_AFTER_NAMESPACE();

#endif
