// What was made of the last self-affine law: curves of a point each, maps and sweeps ask for the same one again and
// again.
#pragma once

#include <memory>
#include <mutex>

#include "asperity/spectrum.hpp"

namespace asperity {

template <class T>
class OfLastLaw {
 public:
  /// That of the law; `make` returns a pointer to it where the last law was another one.
  template <class Make>
  std::shared_ptr<T> operator()(const SelfAffineSpectrum& law, Make make) {
    {
      const std::scoped_lock lock(mutex_);
      if (made_ && law_ == law) return made_;
    }
    std::shared_ptr<T> made = make();
    const std::scoped_lock lock(mutex_);
    law_ = law;
    return made_ = std::move(made);
  }

 private:
  std::mutex mutex_;
  SelfAffineSpectrum law_;
  std::shared_ptr<T> made_;
};

}  // namespace asperity
