// SPDX-License-Identifier: BSD-3-Clause
/// What goes into a checkpoint, and comes back from it: the same calls for both ways.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "breccia/error.hpp"
#include "breccia/strided.hpp"
#include "breccia/types.hpp"

namespace breccia {

class Archive;

namespace archived {

/// How numbers stand in the file.
enum class Element { f64, i32, i64, u8, u32, u64, text };

template <class T>
concept Number = std::is_arithmetic_v<T> || std::is_enum_v<T>;

/// One that says itself what there is of it.
template <class T>
concept Told = requires(T& value, Archive& archive) {
  value.archive(archive);
};

template <class T>
struct Flat {};  // what is a fixed count of numbers has `Scalar` and `count`
template <Number T>
struct Flat<T> {
  using Scalar = T;
  static constexpr std::size_t count = 1;
};
template <class T, int Rows, int Columns>
requires(Rows > 0 && Columns > 0) struct Flat<Eigen::Matrix<T, Rows, Columns>> {
  using Scalar = T;
  static constexpr std::size_t count = std::size_t(Rows * Columns);
};
template <class T>
concept IsFlat = requires {
  typename Flat<T>::Scalar;
};

template <Number T>
constexpr Element element_of() {
  if constexpr (std::is_floating_point_v<T>) return Element::f64;
  else if constexpr (sizeof(T) == 1) return Element::u8;
  else if constexpr (sizeof(T) == 4) return std::is_signed_v<T> ? Element::i32 : Element::u32;
  else return std::is_signed_v<T> ? Element::i64 : Element::u64;
}

}  // namespace archived

/// Named values, in groups. Written and read by the same function, so that neither can forget what the other does:
///
///     bool archive(Archive& archive) override {
///       archive("peak", peak_);
///       archive("history", history_);
///       return true;
///     }
///
/// Takes numbers, enumerations, strings, `Vec3` and the like, vectors and optionals of these, structures that have
/// `void archive(Archive&)`, and structures without pointers that may be copied byte by byte (of which the file keeps
/// the bytes: only the same build of a plugin reads them back). UserError when what is read has another form.
class BRECCIA_API Archive {
 public:
  virtual ~Archive() = default;
  Archive() = default;
  Archive(const Archive&) = delete;
  Archive& operator=(const Archive&) = delete;

  virtual bool reading() const = 0;

  /// What stands between construction and destruction is within a group of this name.
  class Group {
   public:
    Group(Archive& in, std::string_view name) : in_(in), length_(in.path_.size()) {
      in_.path_.append("/").append(name);
      in_.open(in_.path_);
    }
    ~Group() { in_.path_.resize(length_); }
    Group(const Group&) = delete;
    Group& operator=(const Group&) = delete;

   private:
    Archive& in_;
    std::size_t length_;
  };

  template <class T>
  void operator()(std::string_view name, T& value) {
    using namespace archived;
    if constexpr (Told<T>) {
      const Group group(*this, name);
      value.archive(*this);
    } else if constexpr (IsFlat<T>) {
      flat(name, &value, 1, sizeof(T));
    } else if constexpr (std::is_same_v<T, std::string>) {
      std::size_t size = value.size();
      numbers_ahead(name, Element::text, size, 1);
      if (reading()) value.resize(size);
      numbers(name, Element::text, value.data(), size, 1, 1);
    } else if constexpr (is_vector<T>::value) {
      vector(name, value);
    } else if constexpr (is_optional<T>::value) {
      const Group group(*this, name);
      std::uint8_t there = value.has_value();
      (*this)("there", there);
      if (!there) value.reset();
      else if (!value) value.emplace();  // else it keeps what is not in the archive
      if (there) (*this)("value", *value);
    } else {
      static_assert(std::is_trivially_copyable_v<T>,
                    "give this type a member `void archive(Archive&)`: it cannot be copied byte by byte");
      numbers_checked(name, Element::u8, &value, 1, sizeof(T), sizeof(T));
    }
  }

  /// Of each record of a vector the members named, an array each.
  template <class Record, class... T>
  void records(std::string_view name, std::vector<Record>& of, std::pair<const char*, T Record::*>... members) {
    const Group group(*this, name);
    std::uint64_t size = of.size();
    (*this)("size", size);
    if (reading()) {  // as many as there are, before memory is taken for as many as are said to be
      (expect<T>(members.first, size), ...);
      of.resize(size);
    }
    ((*this)(members.first,
             of.empty() ? Strided<T>() : Strided<T>(&(of.front().*members.second), size, sizeof(Record))),
     ...);
  }

  /// As many values as there are: both ways of the same number.
  template <class T>
  void operator()(std::string_view name, Strided<T> values) {
    flat(name, values.data(), values.size(), values.stride());
  }

 protected:
  /// Of `rows` times `columns` numbers at `data`, each row `stride` bytes behind the one before.
  virtual void write(const std::string& path, archived::Element element, const void* data, std::size_t rows,
                     std::size_t columns, std::size_t stride) = 0;
  /// How many rows there are to be read; UserError when there are none such.
  virtual std::size_t rows(const std::string& path, archived::Element element, std::size_t columns) = 0;
  virtual void read(const std::string& path, archived::Element element, void* data, std::size_t rows,
                    std::size_t columns, std::size_t stride) = 0;
  virtual void open(const std::string& group) = 0;
  [[noreturn]] virtual void refuse(const std::string& path, const std::string& why) const = 0;

 private:
  template <class T>
  struct is_vector : std::false_type {};
  template <class T>
  struct is_vector<std::vector<T>> : std::true_type {};
  template <class T>
  struct is_optional : std::false_type {};
  template <class T>
  struct is_optional<std::optional<T>> : std::true_type {};

  template <class T>
  void flat(std::string_view name, T* values, std::size_t size, std::size_t stride) {
    using Scalar = typename archived::Flat<T>::Scalar;
    constexpr std::size_t columns = archived::Flat<T>::count;
    static_assert(std::is_enum_v<Scalar> || sizeof(Scalar) == 8 || sizeof(Scalar) == 4 || sizeof(Scalar) == 1);
    numbers_checked(name, archived::element_of<Scalar>(), values, size, columns, stride);
  }

  template <class T>
  void vector(std::string_view name, std::vector<T>& values) {
    using namespace archived;
    if constexpr (IsFlat<T>) {
      std::size_t size = values.size();
      numbers_ahead(name, element_of<typename Flat<T>::Scalar>(), size, Flat<T>::count);
      if (reading()) values.resize(size);
      numbers(name, element_of<typename Flat<T>::Scalar>(), values.data(), size, Flat<T>::count, sizeof(T));
    } else if constexpr (!Told<T> && std::is_trivially_copyable_v<T>) {
      std::size_t size = values.size();
      numbers_ahead(name, Element::u8, size, sizeof(T));
      if (reading()) values.resize(size);
      numbers(name, Element::u8, values.data(), size, sizeof(T), sizeof(T));
    } else {
      const Group group(*this, name);
      std::uint64_t size = values.size();
      (*this)("size", size);
      if (reading() && size < values.size()) values.resize(size);
      for (std::size_t k = 0; k < size; ++k) {
        if (k == values.size()) values.emplace_back();  // one by one: where there is no more, reading ends
        (*this)(std::to_string(k), values[k]);
      }
    }
  }

  std::string within(std::string_view name) const { return path_ + "/" + std::string(name); }
  void numbers_ahead(std::string_view name, archived::Element element, std::size_t& size, std::size_t columns) {
    if (reading()) size = rows(within(name), element, columns);
  }
  void numbers(std::string_view name, archived::Element element, void* data, std::size_t size, std::size_t columns,
               std::size_t stride) {
    if (reading()) read(within(name), element, data, size, columns, stride);
    else write(within(name), element, data, size, columns, stride);
  }
  void numbers_checked(std::string_view name, archived::Element element, void* data, std::size_t size,
                       std::size_t columns, std::size_t stride) {
    if (reading()) expect_rows(name, element, size, columns);
    numbers(name, element, data, size, columns, stride);
  }
  void expect_rows(std::string_view name, archived::Element element, std::size_t size, std::size_t columns) {
    if (const std::size_t there = rows(within(name), element, columns); there != size)
      refuse(within(name), std::to_string(there) + " values where " + std::to_string(size) + " belong");
  }
  template <class T>
  void expect(std::string_view name, std::size_t size) {
    expect_rows(name, archived::element_of<typename archived::Flat<T>::Scalar>(), size, archived::Flat<T>::count);
  }

  std::string path_;
};

}  // namespace breccia
