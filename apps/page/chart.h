#pragma once

#include <string>
#include <vector>

namespace lagomorph::apps {

/// One line, or one part of stacked bars, of a chart: a value at each place along x.
struct Series {
  std::string name;
  const char* color = "";  // a class of the page's style: "s1" .. "s4"
  std::vector<double> values;
};

/// A diagram of values by frame, as a <figure> that stretches with the page: axes in HTML, the curves as SVG.
struct Chart {
  std::string title;
  std::string unit;            // of y
  std::vector<int> frames;     // ascending; where the values are
  std::vector<Series> series;  // each of frames.size() values
  double fps = 30.0;           // the axis tells seconds
  std::string x_unit = " s";   // after the axis' numbers
  bool bars = false;           // stacked, from 0 on; otherwise lines
};
std::string chart_html(const Chart&);

}  // namespace lagomorph::apps
