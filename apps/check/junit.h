#pragma once

#include <string>

#include "apps/check/result.h"

namespace lagomorph::apps {

/// RUN/check/junit.xml: a case a frame, all in one suite. Every case has a unique name and a time; a failing
/// one its message as attribute and as body, and one system-out whose first attachment is golden | new |
/// heat. Attachments are relative to `from` where they lie under it (a CI's project folder), absolute
/// otherwise.
std::string junit_xml(const CheckResult&, const std::filesystem::path& from);

/// Text for XML 1.0: escaped, without the characters that it cannot hold, invalid UTF-8 replaced.
std::string xml_text(std::string_view text);

}  // namespace lagomorph::apps
