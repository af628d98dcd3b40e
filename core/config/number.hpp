// SPDX-License-Identifier: BSD-3-Clause
/// Decimal numbers: strict reading and shortest writing. Independent of the locale.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace breccia {

/// A number as it was written, before it becomes binary: powers of ten can still be applied without rounding.
struct DecimalText {
  std::string mantissa;    ///< sign, digits and point, without the exponent
  long exponent = 0;       ///< power of ten written after `e`
  std::size_t length = 0;  ///< characters of the text that it took
};

/// The number at the start of `text`: sign, digits, point, exponent. Nothing for "nan", "inf", hexadecimal and the
/// like.
std::optional<DecimalText> scan_decimal(std::string_view text);

/// True for `010`: eight to some YAML readers, ten to others.
bool has_leading_zero(const DecimalText& number);

/// number x 10^shift, correctly rounded; nothing when it overflows, or underflows to zero.
std::optional<double> to_double(const DecimalText& number, int shift = 0);

/// The shortest text that reads back as the same bits ("0.023", "1e10"). `value` must be finite.
std::string format_number(double value);

}  // namespace breccia
