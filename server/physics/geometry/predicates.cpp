#include "physics/geometry/predicates.h"

#include <algorithm>
#include <cmath>

namespace urto {
namespace {

// A sum of doubles kept without rounding: components that do not overlap, smallest first.
struct ExactSum {
  double components[12];
  int count = 0;

  void add(double value) {
    int kept = 0;
    for (int i = 0; i < count; ++i) {
      const double sum = value + components[i];
      const double part = sum - value;
      const double error = (value - (sum - part)) + (components[i] - part);
      if (error != 0) components[kept++] = error;
      value = sum;
    }
    if (value != 0) components[kept++] = value;
    count = kept;
  }

  // Adds a · b (Dekker's product: the rounded value and its error).
  void add_product(double a, double b) {
    constexpr double kSplit = 134217729.0;  // 2²⁷ + 1
    const double a_big = kSplit * a, b_big = kSplit * b;
    const double a_high = a_big - (a_big - a), a_low = a - a_high;
    const double b_high = b_big - (b_big - b), b_low = b - b_high;
    const double product = a * b;
    add(((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low);
    add(product);
  }

  // The last component outweighs all before it.
  int sign() const {
    const double top = count == 0 ? 0.0 : components[count - 1];
    return top > 0 ? 1 : (top < 0 ? -1 : 0);
  }
};

int orientation_exact(const Vec2& a, const Vec2& b, const Vec2& c) {
  ExactSum sum;
  sum.add_product(a.x(), b.y());
  sum.add_product(-a.y(), b.x());
  sum.add_product(b.x(), c.y());
  sum.add_product(-b.y(), c.x());
  sum.add_product(c.x(), a.y());
  sum.add_product(-c.y(), a.x());
  return sum.sign();
}

// c, on the line through a and b, is within their box.
bool between(const Vec2& a, const Vec2& b, const Vec2& c) {
  return std::min(a.x(), b.x()) <= c.x() && c.x() <= std::max(a.x(), b.x()) && std::min(a.y(), b.y()) <= c.y() &&
         c.y() <= std::max(a.y(), b.y());
}

}  // namespace

int orientation(const Vec2& a, const Vec2& b, const Vec2& c) {
  // Shewchuk's bound of the error of this expression: (3 + 16ε)ε of the sum of the sizes, ε = 2⁻⁵³.
  constexpr double kErrorBound = 3.3306690738754716e-16;
  const double left = (a.x() - c.x()) * (b.y() - c.y());
  const double right = (a.y() - c.y()) * (b.x() - c.x());
  const double determinant = left - right;
  const double bound = kErrorBound * (std::abs(left) + std::abs(right));
  if (determinant > bound) return 1;
  if (determinant < -bound) return -1;
  return orientation_exact(a, b, c);
}

bool segments_meet(const Vec2& a0, const Vec2& a1, const Vec2& b0, const Vec2& b1) {
  const int o1 = orientation(a0, a1, b0), o2 = orientation(a0, a1, b1);
  const int o3 = orientation(b0, b1, a0), o4 = orientation(b0, b1, a1);
  if (o1 * o2 < 0 && o3 * o4 < 0) return true;
  return (o1 == 0 && between(a0, a1, b0)) || (o2 == 0 && between(a0, a1, b1)) || (o3 == 0 && between(b0, b1, a0)) ||
         (o4 == 0 && between(b0, b1, a1));
}

}  // namespace urto
