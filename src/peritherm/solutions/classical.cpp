#include "peritherm/solutions/classical.hpp"

#include <cmath>
#include <numbers>

namespace peritherm {
namespace {

constexpr double pi = std::numbers::pi;

/// Beyond this αt/L² the Fourier series is the shorter one; both give all digits there.
constexpr double late = 0.1;

/// Fourier terms are smaller than this part of the first one from here on.
constexpr double negligible = 1e-17;

double fourier_number(const Slab& slab, double t) { return slab.diffusivity * t / (slab.length * slab.length); }

/// Mode n decays by exp(−(nπ/2)² αt/L²).
double decay(int n, double fourier) { return std::exp(-0.25 * pi * pi * n * n * fourier); }

/// Insulated at 0, held at 0 at L, start 1 for x < place, else 0; all images alternate in sign, 2L apart.
double patch_by_images(const Slab& slab, double place, double x, double t) {
  const double width = 2.0 * std::sqrt(slab.diffusivity * t);
  double sum = 0.0;
  for (int k = -4; k <= 4; ++k) {
    const double centre = 2.0 * k * slab.length;
    const double image = 0.5 * (std::erf((x - centre + place) / width) - std::erf((x - centre - place) / width));
    sum += k % 2 == 0 ? image : -image;
  }
  return sum;
}

double patch_by_modes(const Slab& slab, double place, double x, double t) {
  const double fourier = fourier_number(slab, t);
  double sum = 0.0;
  for (int n = 1; decay(n, fourier) > negligible * decay(1, fourier); n += 2) {
    const double wave = 0.5 * n * pi / slab.length;
    sum += 4.0 / (n * pi) * std::sin(wave * place) * std::cos(wave * x) * decay(n, fourier);
  }
  return sum;
}

double patch(const Slab& slab, double place, double x, double t) {
  if (t <= 0.0) return x == place ? 0.5 : (x < place ? 1.0 : 0.0);
  return fourier_number(slab, t) < late ? patch_by_images(slab, place, x, t) : patch_by_modes(slab, place, x, t);
}

/// ∂/∂x of the patch.
double patch_slope(const Slab& slab, double place, double x, double t) {
  if (t <= 0.0) return 0.0;
  double sum = 0.0;
  if (fourier_number(slab, t) < late) {
    const double width = 2.0 * std::sqrt(slab.diffusivity * t);
    for (int k = -4; k <= 4; ++k) {
      const double below = (x - 2.0 * k * slab.length + place) / width;
      const double above = (x - 2.0 * k * slab.length - place) / width;
      const double image = (std::exp(-below * below) - std::exp(-above * above)) / (std::sqrt(pi) * width);
      sum += k % 2 == 0 ? image : -image;
    }
    return sum;
  }
  const double fourier = fourier_number(slab, t);
  for (int n = 1; n * decay(n, fourier) > negligible * decay(1, fourier); n += 2) {
    const double wave = 0.5 * n * pi / slab.length;
    sum -= 2.0 / slab.length * std::sin(wave * place) * std::sin(wave * x) * decay(n, fourier);
  }
  return sum;
}

/// ∫_u^∞ erfc.
double integrated_erfc(double u) { return std::exp(-u * u) / std::sqrt(pi) - u * std::erfc(u); }

/// Σ image(place) over the images of the end at L, at L, 3L, …, which alternate in sign.
template <class Image>
double sum_of_end_images(const Slab& slab, Image&& image) {
  double sum = 0.0;
  for (int n = 0; n <= 4; ++n) {
    const double value = image((2 * n + 1) * slab.length);
    sum += n % 2 == 0 ? value : -value;
  }
  return sum;
}

/// Held at 0 at x = 0, slope 1 at x = L, start 0.
double unit_gradient(const Slab& slab, double x, double t) {
  if (t <= 0.0) return 0.0;
  const double fourier = fourier_number(slab, t);
  if (fourier < late) {
    const double width = 2.0 * std::sqrt(slab.diffusivity * t);
    return sum_of_end_images(slab, [&](double place) {
      return width * (integrated_erfc((place - x) / width) - integrated_erfc((place + x) / width));
    });
  }
  double sum = 0.0;
  for (int n = 1; decay(n, fourier) > negligible; n += 2) {
    const double amplitude = (n % 4 == 1 ? 8.0 : -8.0) * slab.length / (n * n * pi * pi);
    sum += amplitude * std::sin(0.5 * n * pi * x / slab.length) * decay(n, fourier);
  }
  return x - sum;
}

/// ∂/∂x of it.
double unit_gradient_slope(const Slab& slab, double x, double t) {
  if (t <= 0.0) return 0.0;
  const double fourier = fourier_number(slab, t);
  if (fourier < late) {
    const double width = 2.0 * std::sqrt(slab.diffusivity * t);
    return sum_of_end_images(
        slab, [&](double place) { return std::erfc((place - x) / width) + std::erfc((place + x) / width); });
  }
  double sum = 0.0;
  for (int n = 1; decay(n, fourier) > negligible; n += 2) {
    sum += (n % 4 == 1 ? 4.0 : -4.0) / (n * pi) * std::cos(0.5 * n * pi * x / slab.length) * decay(n, fourier);
  }
  return 1.0 - sum;
}

}  // namespace

double slab_with_held_ends(const Slab& slab, double x, double t) {
  const Slab half{0.5 * slab.length, slab.diffusivity};
  return patch(half, half.length, std::abs(x - half.length), t);
}

double square_with_held_sides(const Slab& slab, double x, double y, double t) {
  return slab_with_held_ends(slab, x, t) * slab_with_held_ends(slab, y, t);
}

double cube_with_held_faces(const Slab& slab, double x, double y, double z, double t) {
  return square_with_held_sides(slab, x, y, t) * slab_with_held_ends(slab, z, t);
}

double slab_held_and_insulated(const Slab& slab, double x, double t) {
  return patch(slab, slab.length, slab.length - x, t);
}

double slab_heated_from_one_end(const Slab& slab, double x, double t) {
  return 1.0 - slab_held_and_insulated(slab, x, t);
}

double slab_with_step_start(const Slab& slab, const StepStart& start, double held, double x, double t) {
  return held + (start.right - held) * patch(slab, slab.length, x, t) +
         (start.left - start.right) * patch(slab, start.place, x, t);
}

double slab_with_prescribed_gradient(const Slab& slab, double held, double gradient, double x, double t) {
  return held * slab_heated_from_one_end(slab, x, t) + gradient * unit_gradient(slab, x, t);
}

double slope_of_slab_with_held_ends(const Slab& slab, double x, double t) {
  const Slab half{0.5 * slab.length, slab.diffusivity};
  return std::copysign(1.0, x - half.length) * patch_slope(half, half.length, std::abs(x - half.length), t);
}

double slope_of_slab_held_and_insulated(const Slab& slab, double x, double t) {
  return -patch_slope(slab, slab.length, slab.length - x, t);
}

double slope_of_slab_with_step_start(const Slab& slab, const StepStart& start, double held, double x, double t) {
  return (start.right - held) * patch_slope(slab, slab.length, x, t) +
         (start.left - start.right) * patch_slope(slab, start.place, x, t);
}

double slope_of_slab_with_prescribed_gradient(const Slab& slab, double held, double gradient, double x, double t) {
  return gradient * unit_gradient_slope(slab, x, t) - held * slope_of_slab_held_and_insulated(slab, x, t);
}

double lumped_convection(double start, double ambient, double rate, double t) {
  return ambient + (start - ambient) * std::exp(-rate * t);
}

}  // namespace peritherm
