// SPDX-License-Identifier: BSD-3-Clause
/// One member of each record of an array, or an array as it is: how plugins see what belongs to particles, however the
/// engine keeps it in memory.
#pragma once

#include <cstddef>
#include <iterator>
#include <ranges>
#include <type_traits>
#include <utility>

namespace breccia {

/// Like std::span, but for the distance in memory from one value to the next. What it looks at outlives it.
template <class T>
class Strided {
  using Byte = std::conditional_t<std::is_const_v<T>, const std::byte, std::byte>;
  template <class Range>
  using ElementOf = std::remove_reference_t<std::ranges::range_reference_t<Range>>;

 public:
  using value_type = std::remove_const_t<T>;

  class iterator {
   public:
    using iterator_category = std::random_access_iterator_tag;
    using value_type = Strided::value_type;
    using difference_type = std::ptrdiff_t;
    using pointer = T*;
    using reference = T&;
    iterator() = default;
    T& operator*() const { return *reinterpret_cast<T*>(at_); }
    T* operator->() const { return reinterpret_cast<T*>(at_); }
    T& operator[](difference_type n) const { return *(*this + n); }
    iterator& operator+=(difference_type n) { return at_ += n * stride_, *this; }
    iterator& operator-=(difference_type n) { return *this += -n; }
    iterator& operator++() { return *this += 1; }
    iterator& operator--() { return *this -= 1; }
    iterator operator++(int) { return std::exchange(*this, *this + 1); }
    iterator operator--(int) { return std::exchange(*this, *this - 1); }
    friend iterator operator+(iterator a, difference_type n) { return a += n; }
    friend iterator operator+(difference_type n, iterator a) { return a += n; }
    friend iterator operator-(iterator a, difference_type n) { return a -= n; }
    friend difference_type operator-(const iterator& a, const iterator& b) { return (a.at_ - b.at_) / a.stride_; }
    friend bool operator==(const iterator& a, const iterator& b) { return a.at_ == b.at_; }
    friend auto operator<=>(const iterator& a, const iterator& b) { return a.at_ <=> b.at_; }

   private:
    friend class Strided;
    iterator(Byte* at, std::ptrdiff_t stride) : at_(at), stride_(stride) {}
    Byte* at_ = nullptr;
    std::ptrdiff_t stride_ = sizeof(T);
  };

  constexpr Strided() = default;
  /// `size` values, the first at `first` and the next `stride` bytes behind it each.
  Strided(T* first, std::size_t size, std::size_t stride)
      : first_(reinterpret_cast<Byte*>(first)), size_(size), stride_(stride) {}
  /// Of an array, a vector, a span: this class is none of these, so its own copies are not meant.
  // NOLINTBEGIN(bugprone-forwarding-reference-overload)
  template <std::ranges::contiguous_range Range>
  requires(std::is_convertible_v<ElementOf<Range> (*)[], T (*)[]>) Strided(Range&& range)
      : Strided(std::ranges::data(range), std::ranges::size(range), sizeof(T)) {}
  // NOLINTEND(bugprone-forwarding-reference-overload)
  /// Read only, of what may be written.
  template <class U>
  requires(std::is_same_v<const U, T> && !std::is_const_v<U>) Strided(const Strided<U>& other)
      : Strided(other.data(), other.size(), other.stride()) {}

  T& operator[](std::size_t k) const { return *reinterpret_cast<T*>(first_ + k * stride_); }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T& front() const { return (*this)[0]; }
  T& back() const { return (*this)[size_ - 1]; }
  iterator begin() const { return {first_, std::ptrdiff_t(stride_)}; }
  iterator end() const { return {first_ + size_ * stride_, std::ptrdiff_t(stride_)}; }
  T* data() const { return reinterpret_cast<T*>(first_); }  ///< the first; the next is `stride()` bytes behind it
  std::size_t stride() const { return stride_; }

 private:
  Byte* first_ = nullptr;
  std::size_t size_ = 0, stride_ = sizeof(T);
};

}  // namespace breccia
