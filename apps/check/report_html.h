#pragma once

#include <string>
#include <string_view>

#include "apps/check/report_pictures.h"
#include "apps/check/result.h"

namespace lagomorph::apps {

/// The report as one page: why, the verdict, the worst frames at full size, the others small.
std::string report_html(const CheckResult&, const std::vector<ReportPictures>&);

/// Writes report.html into the result's folder; with `assets` its style, script and pictures as files beside
/// it, in report_files/, so that a server's policy may forbid inline ones.
void write_report_html(const CheckResult&, bool assets);

extern const std::string_view report_style, report_script;

}  // namespace lagomorph::apps
