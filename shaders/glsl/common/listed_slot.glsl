// The slots near dead links (list_dirty), for kernels that follow a cut. Requires listedCounts[] and listed[]; the
// caller returns on NO_SLOT.
#define NO_SLOT ~0u

uint listedSlot() {
    const uint count = listedCounts[push.run], item = itemIndex(count);
    return item < count ? listed[push.first + item] : NO_SLOT;
}
