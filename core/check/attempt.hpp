// SPDX-License-Identifier: BSD-3-Clause
/// A call into a plugin that may end as it likes.
#pragma once

#include <string>

#include "breccia/error.hpp"

namespace breccia {

struct Attempt {
  enum class End { whole, cancelled, refused, fault };
  End end = End::whole;
  std::string text;  ///< of what it threw
  explicit operator bool() const { return end == End::whole; }
};

/// Refused: by a UserError, a text for the user. A fault: by anything else.
template <class F>
Attempt attempt(F&& f) {
  try {
    f();
    return {};
  } catch (const Cancelled& e) { return {Attempt::End::cancelled, e.what()}; } catch (const UserError& e) {
    return {Attempt::End::refused, e.what()};
  } catch (const std::exception& e) { return {Attempt::End::fault, e.what()}; } catch (...) {
    return {Attempt::End::fault, "something that is no exception"};
  }
}

}  // namespace breccia
