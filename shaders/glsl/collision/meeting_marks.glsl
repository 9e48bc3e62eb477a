// Marks of listed pairs for impact zones; 0 = the two do not come within reach in the substep.
#define MEETS 1u      // they do
#define MEETS_FAST 2u // and move so far against each other that contacts may throw points through faces that are in no list

uint meetingMark(float way2, float reach) { return way2 > 16.0 * reach * reach ? MEETS_FAST : MEETS; } // 4 reaches
