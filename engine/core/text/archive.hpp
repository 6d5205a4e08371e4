// SPDX-License-Identifier: GPL-3.0-or-later
/// Values on their way into bytes, or back: one function names them and serves both directions, so that what
/// is written and what is read are the same.
///
///     void checkpoint(Archive& archive) { archive(a_, b_, list_); }
///
/// Numbers and what is made of them, strings, vectors, matrices, optional values, and whatever has such a
/// function itself. The bytes are for the same program on the same machine: no format to exchange. Reading
/// what does not fit throws InvalidScene ("--resume").
#pragma once

#include <concepts>
#include <cstddef>
#include <cstring>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/core/problem.hpp"

namespace extremal {

class Archive {
public:
    /// To be written.
    Archive() = default;
    /// To be read.
    explicit Archive(std::string bytes) : bytes_(std::move(bytes)), isReading_(true) {}

    bool isReading() const { return isReading_; }
    const std::string& bytes() const { return bytes_; }

    template <class... T>
    void operator()(T&... values) {
        (exchange(values), ...);
    }

private:
    template <class T>
    static constexpr bool isMatrix = requires(T& m) {
        typename T::Scalar;
        m.resize(m.rows(), m.cols());
        m.data();
    };

    template <class T>
    void exchange(T& value) {
        if constexpr (requires { value.checkpoint(*this); })
            value.checkpoint(*this);
        else if constexpr (isMatrix<T>)
            exchangeMatrix(value);
        else {
            static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>);
            exchangeBytes(&value, sizeof(T));
        }
    }
    void exchange(std::string& text) { exchangeAll(text); }
    template <class T>
    void exchange(std::vector<T>& values) {
        static_assert(!std::is_same_v<T, bool>);
        if constexpr (std::is_trivially_copyable_v<T>)
            exchangeAll(values);
        else {
            std::size_t size = values.size();
            exchange(size);
            if (size > bytes_.size()) refuse();
            values.resize(size);
            for (T& each : values) exchange(each);
        }
    }
    template <class T>
    void exchange(std::optional<T>& value) {
        bool isThere = value.has_value();
        exchange(isThere);
        if (isReading_ && isThere && !value) value.emplace();
        if (isReading_ && !isThere) value.reset();
        if (value) exchange(*value);
    }
    template <class T>
    void exchangeMatrix(T& m) {
        auto rows = m.rows(), columns = m.cols();
        exchange(rows);
        exchange(columns);
        if (isReading_) {
            if (rows < 0 || columns < 0 || (T::RowsAtCompileTime >= 0 && rows != T::RowsAtCompileTime) ||
                (T::ColsAtCompileTime >= 0 && columns != T::ColsAtCompileTime) ||
                static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns) > bytes_.size())
                refuse();
            m.resize(rows, columns);
        }
        exchangeBytes(m.data(), static_cast<std::size_t>(m.size()) * sizeof(typename T::Scalar));
    }
    /// A string or a vector of numbers.
    template <class T>
    void exchangeAll(T& values) {
        std::size_t size = values.size();
        exchange(size);
        if (isReading_) {
            if (size > bytes_.size()) refuse();
            values.resize(size);
        }
        exchangeBytes(values.data(), size * sizeof(typename T::value_type));
    }
    void exchangeBytes(void* value, std::size_t size) {
        if (size == 0) return;
        if (!isReading_) {
            bytes_.append(static_cast<const char*>(value), size);
            return;
        }
        if (size > bytes_.size() - place_) refuse();
        std::memcpy(value, bytes_.data() + place_, size);
        place_ += size;
    }
    [[noreturn]] static void refuse() {
        throw InvalidScene("--resume", "the checkpoint does not fit the scheme",
                           "leave --resume out to begin anew");
    }

    std::string bytes_;
    std::size_t place_ = 0;  ///< of what is read next
    bool isReading_ = false;
};

}  // namespace extremal
