// The greatest safe speed towards something at a distance: docs/contract.md section 5.
#pragma once

namespace lakshya {

struct GovernorParams {
  double max_speed_mps = 7;      // v_max, >= 0
  double latency_s = 0.25;       // t_latency, >= 0: the vehicle goes on unbraked
  double deceleration_mps2 = 2;  // a, > 0
  double stop_margin_m = 0.3;    // margin, >= 0, kept when stopped
  double contact_time_s = 2.8;   // t_contact, >= 0; 0: no such limit
};

// The largest v in [0, v_max] with
//   v t_latency + v^2 / (2 a) <= clear_m - margin    (reaction and braking distance)
//   v t_contact <= clear_m                           (S. Kumar's vehicle Lakshya: 20 m at 7 m/s, 2.8 s)
// The first one's root, with D = clear_m - margin, is v = 2 D / (t + sqrt(t^2 + 2 D / a)), a form without
// cancellation. clear_m and margin are measured from the same point. clear_m may be infinite.
double governed_speed(double clear_m, const GovernorParams& params);

}  // namespace lakshya
