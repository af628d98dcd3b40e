// SPDX-License-Identifier: BSD-3-Clause
/// A chart that becomes part of a page.
#pragma once

#include <optional>
#include <string>

namespace breccia::report {

struct InlineSvg {
  std::string markup;  ///< `<svg ...>`, with its title as accessible name
  std::string title;   ///< what the file calls it; may be empty
};

/// Its ids begin with `prefix`, so that several files stand in one page. None when the file is no SVG, or has anything
/// in it that is not plain drawing (scripts, style sheets, references to the outside): such a file is a picture, which
/// a browser keeps apart.
std::optional<InlineSvg> inline_svg(const std::string& text, const std::string& prefix,
                                    const std::string& fallback_title);

}  // namespace breccia::report
