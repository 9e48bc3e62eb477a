// Part of the kernels that follow a cut: the slots near the links that died (list_dirty). Whoever includes this has listedCounts[] and
// listed[]; the caller returns where there is none.
#define NO_SLOT ~0u

uint listedSlot() {
    const uint count = listedCounts[push.run], item = itemIndex(count);
    return item < count ? listed[push.first + item] : NO_SLOT;
}
