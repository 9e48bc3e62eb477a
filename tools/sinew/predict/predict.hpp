// A model of a GPU that need not be there: how long the passes of a step would take on it, and why. Every
// figure is predicted, none is measured.
#pragma once

#include "sim/program/program.hpp"

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::tools {

/// A GPU as the model sees it; cards.csv has the sources of those that are shipped.
struct Card {
    std::string name;
    double simds = 0;      ///< units that each issue an instruction a cycle
    double lanes = 0;      ///< invocations of a wave
    double waves = 0;      ///< most that a SIMD holds at a time
    double ghz = 0;        ///< clock
    double gigabytes = 0;  ///< memory bandwidth [GB/s]
    double dispatchUs = 0; ///< a dispatch that waits for the one before it, without its work [us]
    double emptyUs = 0;    ///< an indirect dispatch of no groups [us]
};

/// Costs of a kernel in waves of 32 invocations, as a compiler estimates them: those of the specialisation
/// with the median latency.
struct KernelCost {
    double waves = 0;   ///< that fit into a SIMD, of 32
    double latency = 0; ///< of one wave [cycles]
    double issue = 0;   ///< cycles of a SIMD a wave, if it holds enough of them
};
using KernelCosts = std::map<std::string, KernelCost, std::less<>>;

/// The cards of cards.csv, and the kernels as Mesa's ACO compiles them for NAVI21 (kernels.csv).
std::vector<Card> shippedCards();
KernelCosts shippedKernels();

/// Reads a table in the form of cards.csv. `file` is the name that errors show. Throws app::Failure
/// (badInput) for a wrong heading, a value that is no number above 0, or no card.
std::vector<Card> readCards(std::string_view text, const std::string& file);
/// Throws app::Failure (badInput) also for a file that cannot be read.
std::vector<Card> loadCards(const std::string& file);

/// The card of that name. Throws app::Failure (wrongUsage) with the names that exist.
Card findCard(const std::vector<Card>& cards, const std::string& name);

enum class Bound { dispatch, latency, issue, memory };

/// The passes of a step with one label.
struct PassCost {
    std::string label;
    std::size_t count = 0;
    double leastUs = 0, mostUs = 0; ///< sums; least: indirect dispatches are empty; most: they are full
    Bound bound = Bound::dispatch;  ///< what the most of its time goes to, in the last of them
};

struct Prediction {
    std::vector<PassCost> passes; ///< longest first, by mostUs
    double leastUs = 0, mostUs = 0;
    std::string longest;  ///< label of the longest single pass
    double longestUs = 0; ///< of that pass, at most, without its launch
    std::size_t dispatches = 0, indirect = 0, barriers = 0;
    std::vector<std::string> unknown; ///< kernels of no known cost; they count as the longest known one
};

/// The time of a dispatch's work alone [us]: `items` invocations of a kernel that touch `bytes`.
double workUs(const Card& card, const KernelCost& kernel, double items, double bytes, Bound& bound);

/// The launches of a step alone, with empty indirect dispatches [us].
double launchUs(const sim::StepProgram& program, const Card& card, sim::Recording recording);

/// A pass that waits for another takes dispatchUs and its work; one without a barrier before it runs beside
/// those before, and takes its work alone. Fills and copies are dispatches that only touch memory.
Prediction predict(const sim::StepProgram& program, const Card& card, const KernelCosts& kernels,
                   sim::Recording recording);

/// A driver resets a device whose work does not end within some seconds, and programs that share the device
/// wait for a dispatch: no single one should take longer than this.
inline constexpr double longestAllowedUs = 100'000;

/// The longest passes of a step, and of a calm one if that differs, as a table.
std::string predictionText(const sim::StepProgram& program, const Card& card, const KernelCosts& kernels);

} // namespace sinew::tools
