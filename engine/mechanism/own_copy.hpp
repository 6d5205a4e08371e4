// SPDX-License-Identifier: GPL-3.0-or-later
/// A pointer to an object with virtual functions, of which copies have an object of their own.
#pragma once

#include <memory>
#include <utility>

namespace extremal {

/// T has clone().
template <class T>
class OwnCopy {
public:
    OwnCopy() = default;
    explicit OwnCopy(std::unique_ptr<T> object) : object_(std::move(object)) {}
    OwnCopy(const OwnCopy& other) : object_(other.object_ ? other.object_->clone() : nullptr) {}
    OwnCopy(OwnCopy&&) noexcept = default;
    OwnCopy& operator=(OwnCopy other) noexcept {
        object_ = std::move(other.object_);
        return *this;
    }
    ~OwnCopy() = default;
    explicit operator bool() const { return static_cast<bool>(object_); }
    T* operator->() const { return object_.get(); }
    T& operator*() const { return *object_; }

private:
    std::unique_ptr<T> object_;
};

}  // namespace extremal
