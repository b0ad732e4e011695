#pragma once

#include <cstddef>
#include <string>

#include "apps/check/result.h"

/// What continuous integration is told beside the reports.
namespace lagomorph::apps {

/// Tags that CTest takes out of a test's output and CDash shows: the worst figures, and the worst frame's
/// golden | new | heat.
std::string ctest_measurements(const CheckResult&);

/// The most that is appended to a job's summary, with what is in it: GitHub drops one of more than 1 MiB.
/// [bytes]
inline constexpr std::size_t most_summary_bytes = 900 * 1024;

/// Markdown for a job's summary of at most `room` bytes: the verdict, then failing frames, worst first; only
/// words, since GitHub shows no data URIs.
std::string github_summary(const CheckResult&, std::size_t room = most_summary_bytes);

/// At most ten workflow commands, one a failing frame.
std::string github_annotations(const CheckResult&);

/// Appends the summary to the file that GITHUB_STEP_SUMMARY names. Throws Error(wrong_input) when it is not
/// set, Error(machine) when it cannot be written.
void append_github_summary(const CheckResult&);
/// Throws as that does when there is nowhere to append to.
void require_github_summary();

}  // namespace lagomorph::apps
