// What `billet render` can be asked for: its help, which billet and billet-render both print.

#pragma once

#include <string_view>

namespace billet::render {

inline constexpr std::string_view usage_text =
    R"(billet render RESULTS [options]        a picture of the part: RESULTS is a folder, .pvd or .vtu
billet render RESULTS --animate        a film of all frames
billet render RESULTS... --curve       the force on each tool over its stroke
billet render RESULTS... --curve X:Y   columns of history.csv
billet render --curve SERIES...        columns of any tables

what is shown
  --field NAME[:COMPONENT]    coloured by a field (von_mises): plastic_strain, contact_pressure, ...;
                              a component is x, y, z or xx, yy, zz, xy, yz, xz, without one a vector
                              is shown by its length; none: the part in grey. Short words: mises,
                              strain, strain_rate, pressure, friction, slip, wear, status, quality
  --on workpiece|contact|tools
                              where the field is shown: contact are the faces that may touch (gap),
                              tools have their wear and take what the part has where they touch it
                              (where the results have it)
  --time T|last               the frame nearest to this time (last)
  --times T1,T2,...           several, next to each other, with the same scale and colours
  --compare RESULTS2          the same frame of other results next to it
  --range LOW:HIGH            of the colours (2nd to 98th percentile of all frames shown)
  --bands N                   N colours in place of a smooth scale
  --arrows FIELD              a vector field as arrows: velocity, displacement, friction
  --arrow-scale F             F times the usual length
  --flow-lines N              instead of the mesh N + N lines that were straight before the run
                              (scenes of the plane)
  --mesh                      with the edges of elements, as without an option
  --no-mesh                   without them

the part as a whole
  --mirror [PLANES]           mirror images: in all planes of symmetry that the results know, in those
                              of the axes x, y, z or xy, or in x=0,y=2.5 (axisymmetric: in the axis)
  --no-mirror                 without
  --copies N                  N copies of a sector around the axis that points upwards
  --revolve [DEGREES]         an axisymmetric part as a body of that angle (270)
  --cut PLANE[,PLANE]         takes away what lies between the viewer and x=3.5; two planes take a
                              quarter; x<3.5 and x>3.5 keep what they say. May be given again
  --tools glass|solid|outline|none
                              how tools are drawn (glass)

from where
  --view x|-x|y|-y|z|-z|iso|AZIMUTH,ELEVATION
                              the viewer stands on that axis, or at these angles in degrees (iso, in
                              the plane z)
  --up x|y|z                  the axis that points upwards (z, in the plane and revolved y)
  --zoom F                    F times the scale at which all is in the picture
  --focus X,Y,Z               what is in the middle

films
  --animate                   all frames: RESULTS/FIELD.gif, or by the name of the output: film.gif, film.mp4 (both
                              need the program ffmpeg), film_%04d.png
  --fps N                     frames a second (10)
  --frames A:B:STEP           frames A to B, counted from 0; each may be left out

curves
  --curve                     curves in place of the part
  X:Y[,Y2]                    columns of history.csv of one or several results; -COLUMN turns the sign
  SERIES                      FILE.csv:X-COLUMN:Y-COLUMN[:LABEL]
  --points SERIES             the same, as markers
  --x-label TEXT              of the axis to the right
  --y-label TEXT              of the axis upwards
  --tight                     axes as long as the curves (from zero)
  --log-x, --log-y            logarithmic axes; values at or below zero are left out

all
  -o, --output FILE           the picture, or a folder (in the results, FIELD.png, FIELD.gif,
                              load-stroke.png or history.png)
  --size WxH                  pixels (1200x900, a GIF 800x600)
  --title TEXT
)";

} // namespace billet::render
