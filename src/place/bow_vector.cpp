#include "place/bow_vector.h"

#include <algorithm>

namespace cpslam {

double score(const BowVector& a, const BowVector& b) {
  double sum = 0.0;
  auto in_a = a.begin();
  auto in_b = b.begin();
  while (in_a != a.end() && in_b != b.end()) {
    if (in_a->word < in_b->word) {
      ++in_a;
    } else if (in_b->word < in_a->word) {
      ++in_b;
    } else {
      sum += static_cast<double>(std::min(in_a->weight, in_b->weight));
      ++in_a;
      ++in_b;
    }
  }
  return sum;
}

}  // namespace cpslam
