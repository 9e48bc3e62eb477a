// Scales a compliance [m/N] for a constraint solved in a substep of h [s]; used by links, bends and attachments.

// compliance / h^2 [1/kg], finite: Inf would turn into NaN.
float scaledCompliance(float compliance, float h) { return min(compliance / (h * h), 1e30); }
