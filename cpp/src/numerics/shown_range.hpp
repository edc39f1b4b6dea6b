// Numbers in the message that one of them is out of a range, with the fewest digits that tell.
#pragma once

#include <string>

#include "asperity/errors.hpp"

namespace asperity {

/// A range of positive numbers as a message shows it. Its ends are rounded inwards: whoever types them is inside of it.
class ShownRange {
 public:
  ShownRange(double lowest, double highest);
  [[nodiscard]] Phrase lowest() const;
  [[nodiscard]] Phrase highest() const;
  /// "[lowest, highest]"
  [[nodiscard]] Sentence text() const;
  /// A number with six digits, or as many more as show on which side of the range it lies.
  [[nodiscard]] Phrase value(double x) const;

 private:
  [[nodiscard]] int side(double x) const;
  double lowest_, highest_;
  int digits_;
};

}  // namespace asperity
